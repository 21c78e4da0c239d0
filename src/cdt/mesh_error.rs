//! Why the one call for users made no mesh.

use crate::check::Findings;
use crate::error::Failure;
use crate::exchange::Plc;
use crate::report::Report;
use std::fmt;

/// Why [`mesh`](super::mesh) made no mesh. It displays with vertices, facets and points as the input numbers them.
#[derive(Clone, Debug)]
pub struct MeshError {
    /// What stopped the run. Where the input has been repaired, its facets are those of the input that the repaired
    /// ones come from.
    pub failure: Box<Failure>,
    /// What is wrong with the input, if it was looked at and anything was found: of what cannot be repaired or, where
    /// nothing may be repaired, of everything, the first things. Then these are the reason, whatever the algorithm ran
    /// into.
    pub findings: Option<Box<Findings>>,
    /// The report as far as the run came.
    pub report: Box<Report>,
    message: String,
}

impl MeshError {
    /// How many findings are listed.
    pub(super) const LISTED: usize = 8;

    /// A failure on a valid PLC: the input, or what it was repaired to.
    pub(super) fn new(plc: &Plc, mut failure: Failure, report: Report) -> MeshError {
        let message = failure.describe(plc);
        failure.name_origins(plc);
        MeshError {
            message,
            failure: Box::new(failure),
            findings: None,
            report: Box::new(report),
        }
    }

    /// An error of an input that is not valid: whatever the algorithm ran into, the input is to blame, and the findings
    /// name facets more closely.
    pub(super) fn of_findings(
        plc: &Plc,
        failure: Failure,
        findings: Box<Findings>,
        report: Report,
    ) -> MeshError {
        let message = match &failure {
            // Where a surface is open is one thing, what intersects another; both are to be mended.
            Failure::Plc(_) | Failure::Domain(_) => {
                let mut lines = vec![failure.describe(plc)];
                lines.extend(listed(plc, &findings, &lines[0]));
                lines.join("\n")
            }
            // What the algorithm ran into first may depend on when the input was looked at.
            _ => format!("invalid PLC: {}", listed(plc, &findings, "").join("\n")),
        };
        MeshError {
            failure: Box::new(failure),
            findings: Some(findings),
            report: Box::new(report),
            message,
        }
    }

    /// Whether the input is to blame, and not the algorithm.
    pub fn is_of_input(&self) -> bool {
        self.findings.is_some() || self.failure.is_of_input()
    }

    /// Whether the input would be repaired, as far as it was looked at, if that were allowed
    /// ([`MeshOptions::strict`](super::MeshOptions::strict)).
    pub fn is_repairable(&self) -> bool {
        self.findings.as_ref().is_some_and(|f| f.is_repairable())
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for MeshError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&*self.failure)
    }
}

/// What was found, one line each, without what has been `told` already.
fn listed(plc: &Plc, findings: &Findings, told: &str) -> Vec<String> {
    let errors = findings.errors.iter().map(ToString::to_string);
    let conflicts = findings.conflicts.iter().map(|c| c.describe(plc));
    let mut lines: Vec<String> = errors
        .chain(conflicts)
        .filter(|line| told.is_empty() || !told.ends_with(line))
        .collect();
    if lines.len() > MeshError::LISTED || findings.stopped {
        lines.truncate(MeshError::LISTED);
        lines.push("…".to_owned());
    }
    lines
}
