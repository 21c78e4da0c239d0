//! Which scenes, and how much time for each.

/// How many polygons of a model are updated.
pub const MOST_POLYGONS: usize = 300;

/// What to run.
pub struct Plan {
    /// About how many crossing tetrahedra a scene has.
    pub scenes: Vec<u64>,
    /// Rounds of updates are repeated for so long.
    pub seconds: f64,
}

impl Plan {
    /// Half a minute.
    pub fn full() -> Plan {
        Plan {
            scenes: vec![100, 300, 1000, 3000, 10_000, 30_000, 100_000],
            seconds: 0.5,
        }
    }

    /// A few seconds.
    pub fn quick() -> Plan {
        Plan {
            scenes: vec![100, 1000],
            seconds: 0.0,
        }
    }
}
