//! Which scenes, and how much time for each.

use crate::scene::Slab;
use crate::turns::Effort;

/// What to run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The scenes, in the order of the rows.
    pub scenes: Vec<Slab>,
    /// How often each insertion is timed.
    pub effort: Effort,
}

/// The half height of all scenes.
pub const HALF_HEIGHT: f64 = 0.01;

impl Plan {
    /// From about 30 crossing tetrahedra to 100 000, with the paper's two ranges in small steps.
    pub fn full() -> Plan {
        let small = (10..=32).step_by(2).map(|n| (n, 5));
        let paper = (40..=560).step_by(20).map(|n| (n, 3));
        let large = [
            (900, 3),
            (1800, 3),
            (4500, 3),
            (9000, 3),
            (18_000, 2),
            (30_000, 2),
        ];
        Plan {
            scenes: scenes(small.chain(paper).chain(large)),
            effort: Effort {
                seconds: 0.35,
                least: 3,
                most: 501,
                of_slow: 0,
            },
        }
    }

    /// The same questions in a few seconds, not fit for conclusions about time.
    pub fn quick() -> Plan {
        Plan {
            scenes: scenes([(10, 2), (30, 2), (60, 2), (300, 2), (1000, 1)]),
            effort: Effort {
                seconds: 0.05,
                least: 3,
                most: 21,
                of_slow: 0,
            },
        }
    }
}

/// A scene's part of the progress bar: small ones fill their time, large ones need a time in proportion to their size.
pub fn weight(slab: &Slab) -> u64 {
    slab.vertices.max(1000) as u64
}

/// Scenes with seeds 1, 2, … for each pair of a number of vertices and a number of seeds.
fn scenes(sizes: impl IntoIterator<Item = (usize, u64)>) -> Vec<Slab> {
    let scenes = sizes.into_iter().flat_map(|(vertices, seeds)| {
        (1..=seeds).map(move |seed| Slab {
            vertices,
            half_height: HALF_HEIGHT,
            seed,
        })
    });
    scenes.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_scene_twice() {
        for plan in [Plan::full(), Plan::quick()] {
            let mut names: Vec<_> = plan.scenes.iter().map(|s| (s.vertices, s.seed)).collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), plan.scenes.len());
        }
    }
}
