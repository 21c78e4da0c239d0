//! Which sizes.

use crate::rivals::points::Spread;
use tetflip::generate::Kind;

/// What is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// The Delaunay tetrahedralization of uniform points.
    Points,
    /// The CDT of a generated surface.
    Surface(Kind),
}

impl Work {
    /// All.
    pub const ALL: [Work; 3] = [
        Work::Points,
        Work::Surface(Kind::Terrain),
        Work::Surface(Kind::Cells),
    ];

    /// The word of tables.
    pub fn word(self) -> &'static str {
        match self {
            Work::Points => Spread::Cube.word(),
            Work::Surface(kind) => kind.name(),
        }
    }
}

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Task {
    /// Of what.
    pub work: Work,
    /// Points or facets.
    pub size: usize,
}

impl Task {
    /// For messages.
    pub fn name(&self) -> String {
        format!("{}/{}", self.work.word(), self.size)
    }
}

/// What to run.
pub struct Plan {
    /// In the order of the rows.
    pub tasks: Vec<Task>,
}

impl Plan {
    /// Minutes.
    pub fn full() -> Plan {
        Plan::up_to(7, 6)
    }

    /// Seconds.
    pub fn quick() -> Plan {
        Plan::up_to(4, 3)
    }

    /// Powers of ten from a thousand on.
    fn up_to(points: u32, facets: u32) -> Plan {
        let tasks = Work::ALL.into_iter().flat_map(|work| {
            let last = if work == Work::Points { points } else { facets };
            (3..=last).map(move |e| Task {
                work,
                size: 10usize.pow(e),
            })
        });
        Plan {
            tasks: tasks.collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_million_points() {
        let largest = |plan: Plan| plan.tasks.iter().map(|t| t.size).max();
        assert_eq!(largest(Plan::full()), Some(10_000_000));
        assert_eq!(largest(Plan::quick()), Some(10_000));
    }
}
