//! The ways to insert polygons that the experiments compare, and their names in tables and plots.

use std::fmt;
use tetflip::recover::polygons::{FlipOrder, Insertion, NumberType};

/// One way to insert polygons.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Method(pub Insertion);

impl Method {
    /// The ways to compare at all sizes, in the order of tables: cavity retriangulation, then flips with each number
    /// type that this build has. Gift wrapping takes quadratic time and is not among them.
    pub fn all() -> Vec<Method> {
        let times = [
            FlipOrder::new(NumberType::F32),
            FlipOrder::new(NumberType::F64Plain),
            FlipOrder::EXACT,
            FlipOrder::FILTERED,
            #[cfg(feature = "rug")]
            FlipOrder::new(NumberType::Rug),
        ];
        let flips = times.into_iter().map(|t| Method(Insertion::Flip(t)));
        [Method(Insertion::Cavity)]
            .into_iter()
            .chain(flips)
            .collect()
    }

    /// The algorithm: the column `insertion`.
    pub fn insertion(self) -> &'static str {
        match self.0 {
            Insertion::Cavity => "cavity",
            Insertion::GiftWrap => "gift-wrap",
            Insertion::Flip(_) => "flip",
        }
    }

    /// The number type of the flip times: the column `times`. Only flips have them.
    pub fn times(self) -> String {
        match self.0 {
            Insertion::Cavity | Insertion::GiftWrap => String::new(),
            Insertion::Flip(times) => times.to_string(),
        }
    }

    /// Whether a flat polygon can always be inserted in this way. Rounded flip times can fail (paper, §3.4).
    pub fn always_succeeds(self) -> bool {
        match self.0 {
            Insertion::Cavity | Insertion::GiftWrap => true,
            Insertion::Flip(times) => times.is_exact(),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let times = self.times();
        let space = if times.is_empty() { "" } else { " " };
        f.pad(&format!("{}{space}{times}", self.insertion()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_differ() {
        let names: Vec<String> = Method::all().iter().map(Method::to_string).collect();
        assert_eq!(names[..3], ["cavity", "flip f32", "flip f64:plain"]);
        assert_eq!(names[3..5], ["flip exact", "flip filtered"]);
        assert_eq!(names.len(), if cfg!(feature = "rug") { 6 } else { 5 });
        let wrapping = Method(Insertion::GiftWrap).to_string();
        assert!(wrapping == "gift-wrap" && !names.contains(&wrapping));
    }

    #[test]
    fn only_rounded_times_may_fail() {
        let safe = Method::all().into_iter().filter(|m| m.always_succeeds());
        let times: Vec<String> = safe.map(Method::times).collect();
        assert_eq!(times[..3], ["", "exact", "filtered"]);
        assert!(
            !times
                .iter()
                .any(|t| ["f32", "f64:plain"].contains(&t.as_str()))
        );
    }
}
