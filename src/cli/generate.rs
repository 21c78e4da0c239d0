//! `tetflip generate`: models of any size, as `.poly` files.

use super::{Stop, say};
use clap::builder::{PossibleValue, RangedU64ValueParser};
use std::path::PathBuf;
use tetflip::format::write_poly;
use tetflip::generate::{Kind, MOST_FACETS, generate};

#[derive(clap::Args)]
pub(crate) struct GenerateArguments {
    /// The kind of model; --list says what there is.
    #[arg(
        value_enum,
        hide_possible_values = true,
        required_unless_present = "list"
    )]
    kind: Option<KindArgument>,
    /// What to draw random numbers from: the same seed gives the same model on every machine.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// About how many facets there should be: from half to twice as many.
    #[arg(long, value_name = "FACETS", default_value_t = 1000,
        value_parser = RangedU64ValueParser::<usize>::new().range(1..=MOST_FACETS as u64))]
    size: usize,
    /// Where to write the model: NAME.poly.
    #[arg(short, long, required_unless_present = "list")]
    output: Option<PathBuf>,
    /// List the kinds, with the number of facets each has at least.
    #[arg(long, exclusive = true)]
    list: bool,
    /// No summary.
    #[arg(short, long)]
    quiet: bool,
}

/// A kind, with the library's names and descriptions.
#[derive(Clone, Copy)]
struct KindArgument(Kind);

impl clap::ValueEnum for KindArgument {
    fn value_variants<'a>() -> &'a [KindArgument] {
        const ALL: [KindArgument; Kind::ALL.len()] = {
            let mut all = [KindArgument(Kind::ALL[0]); Kind::ALL.len()];
            let mut i = 0;
            while i < all.len() {
                all[i] = KindArgument(Kind::ALL[i]);
                i += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()).help(self.0.about()))
    }
}

/// Makes the model and writes it.
pub(crate) fn generate_file(arguments: &GenerateArguments) -> Result<(), Stop> {
    let (Some(KindArgument(kind)), Some(output)) = (arguments.kind, &arguments.output) else {
        for kind in Kind::ALL {
            say(&format!("{kind:<12} {:>4}  {}", kind.least(), kind.about()));
        }
        return Ok(());
    };
    let extension = output.extension().unwrap_or_default();
    if !extension.eq_ignore_ascii_case("poly") {
        return Err(Stop::input(format!(
            "{}: models are written as .poly files",
            output.display()
        )));
    }
    let plc = generate(kind, arguments.seed, arguments.size);
    write_poly(output, &plc).map_err(Stop::input)?;
    if !arguments.quiet {
        say(&format!(
            "{kind}, seed {}: {} vertices, {} facets, {} segments, {} holes, {} regions",
            arguments.seed,
            plc.vertices.len(),
            plc.facets.len(),
            plc.segments.len(),
            plc.holes.len(),
            plc.regions.len(),
        ));
    }
    Ok(())
}
