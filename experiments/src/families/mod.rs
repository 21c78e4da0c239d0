//! Families of small PLCs on which the order of flips is hard to get right: exact and near ties, extreme shapes,
//! several polygons. All polygons of all members are exactly flat, so that flips in exact order must succeed.
//!
//! A [`Member`] is named by family, subfamily and seed, and the name gives the same bits everywhere. Its vertices are
//! in random order, because their order decides the perturbation.

mod boxes;
pub mod draw;
mod generic;
mod lattice;
mod near_coplanar;
mod needles;
mod planes;
pub mod prism;
mod rectangle;
mod sphere;
mod walls;

pub use draw::Draw;

use std::fmt;
use std::str::FromStr;
use tetflip::cdt::Cdt;
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::report::Report;
use thiserror::Error;

/// A family of PLCs.
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// The names of its subfamilies.
    pub subfamilies: &'static [&'static str],
    /// A candidate of a subfamily; one that needs Steiner points off a polygon's plane is replaced by the next.
    candidate: fn(&str, &mut Draw) -> Plc,
}

impl Family {
    /// How many seeds of each subfamily make at least n members.
    fn seeds_for(&self, n: u64) -> u64 {
        n.div_ceil(self.subfamilies.len() as u64)
    }
}

/// All families, in the order of tables.
pub static FAMILIES: [Family; 10] = [
    generic::FAMILY,
    lattice::FAMILY,
    sphere::FAMILY,
    prism::FAMILY,
    planes::FAMILY,
    boxes::FAMILY,
    walls::FAMILY,
    near_coplanar::FAMILY,
    needles::FAMILY,
    // Not beside `random`: the place of a family chooses the stream of its members.
    rectangle::FAMILY,
];

/// One PLC of a family. Displayed, and parsed, as `family/subfamily:seed`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Member {
    family: usize,
    subfamily: usize,
    /// The seed of ChaCha8; family and subfamily choose the stream.
    pub seed: u64,
}

/// No member has this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no PLC is called `{0}`; names are FAMILY/SUBFAMILY:SEED, for instance prism/right:7")]
pub struct UnknownMember(String);

/// A member with its segments recovered.
pub struct Prepared {
    /// The PLC.
    pub plc: Plc,
    /// The Delaunay tetrahedralization of its vertices, with Steiner points on its segments; no polygon is inserted.
    pub cdt: Cdt,
    /// The Steiner points.
    pub steiner_points: usize,
}

/// Candidates that are tried for one member.
const MOST_CANDIDATES: usize = 1000;

impl Member {
    /// The members of all subfamilies with seeds 0, …, n − 1: first all with seed 0, and so on, so that the first
    /// ones are of all kinds.
    pub fn all(seeds: u64) -> Vec<Member> {
        Member::with_seeds(|_| seeds)
    }

    /// At least n members of each family, and as many of each of its subfamilies, in the same order.
    pub fn of_each_family(n: u64) -> Vec<Member> {
        Member::with_seeds(|family| family.seeds_for(n))
    }

    fn with_seeds(seeds: impl Fn(&Family) -> u64) -> Vec<Member> {
        let most = FAMILIES.iter().map(&seeds).max().unwrap_or(0);
        let mut members = Vec::new();
        for seed in 0..most {
            for (family, f) in FAMILIES.iter().enumerate().filter(|(_, f)| seed < seeds(f)) {
                members.extend((0..f.subfamilies.len()).map(|subfamily| Member {
                    family,
                    subfamily,
                    seed,
                }));
            }
        }
        members
    }

    /// Whether it is among the first n or a few more of its family.
    pub fn is_among_first(&self, n: u64) -> bool {
        self.seed < FAMILIES[self.family].seeds_for(n)
    }

    /// The name of the family.
    pub fn family(&self) -> &'static str {
        FAMILIES[self.family].name
    }

    /// The name of the subfamily.
    pub fn subfamily(&self) -> &'static str {
        FAMILIES[self.family].subfamilies[self.subfamily]
    }

    /// What members are sorted by: family and subfamily in the order of tables, then the seed.
    pub fn key(&self) -> (usize, usize, u64) {
        (self.family, self.subfamily, self.seed)
    }

    /// The PLC, its Delaunay tetrahedralization and segments: of the first candidate whose polygons stay exactly flat,
    /// either because it needs no Steiner points, or because the planes of all polygons are parallel to two axes, so
    /// that rounded Steiner points stay on them. Whether polygons can be inserted is not asked.
    ///
    /// # Panics
    /// If a thousand candidates are of no use. That would be a fault of the family.
    pub fn prepare(&self) -> Prepared {
        let stream = (self.family * 64 + self.subfamily) as u64;
        let mut draw = Draw::new(self.seed, stream);
        for _ in 0..MOST_CANDIDATES {
            let mut plc = (FAMILIES[self.family].candidate)(self.subfamily(), &mut draw);
            shuffle_vertices(&mut plc, &mut draw);
            let mut report = Report::default();
            let Ok(cdt) = Cdt::with_segments(&plc, true, &mut report) else {
                continue;
            };
            let steiner_points = report.steiner_points;
            if steiner_points == 0 || is_axis_parallel(&plc) {
                return Prepared {
                    plc,
                    cdt,
                    steiner_points,
                };
            }
        }
        panic!("{self}: no usable candidate");
    }
}

impl fmt::Display for Member {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}:{}", self.family(), self.subfamily(), self.seed)
    }
}

impl FromStr for Member {
    type Err = UnknownMember;

    fn from_str(name: &str) -> Result<Member, UnknownMember> {
        let parse = || {
            let (kind, seed) = name.split_once(':')?;
            let (family, subfamily) = kind.split_once('/')?;
            let family = FAMILIES.iter().position(|f| f.name == family)?;
            let mut subfamilies = FAMILIES[family].subfamilies.iter();
            Some(Member {
                family,
                subfamily: subfamilies.position(|&s| s == subfamily)?,
                seed: seed.parse().ok()?,
            })
        };
        parse().ok_or_else(|| UnknownMember(name.to_string()))
    }
}

/// Whether every facet has one coordinate that all its vertices share.
fn is_axis_parallel(plc: &Plc) -> bool {
    plc.facets.iter().all(|facet| {
        let mut vertices = facet.polygons.iter().flatten();
        let first = vertices.next().expect("a facet has vertices");
        let of = |v: &VertexId, axis: usize| plc.vertices[v.index()][axis];
        (0..3).any(|axis| vertices.clone().all(|v| of(v, axis) == of(first, axis)))
    })
}

/// Numbers the vertices anew, in random order.
fn shuffle_vertices(plc: &mut Plc, draw: &mut Draw) {
    let mut order: Vec<usize> = (0..plc.vertices.len()).collect();
    draw.shuffle(&mut order);
    let mut place = vec![0; order.len()];
    for (new, &old) in order.iter().enumerate() {
        place[old] = new;
    }
    plc.vertices = order.iter().map(|&old| plc.vertices[old]).collect();
    for v in plc
        .facets
        .iter_mut()
        .flat_map(|f| &mut f.polygons)
        .flatten()
    {
        *v = VertexId::new(place[v.index()]);
    }
}

/// A facet with one polygon, by its vertices.
fn facet(vertices: impl IntoIterator<Item = usize>) -> Facet {
    Facet {
        polygons: vec![vertices.into_iter().map(VertexId::new).collect()],
        ..Facet::default()
    }
}

/// A PLC whose one facet is the polygon of the first `corners` vertices.
fn one_polygon(vertices: Vec<[f64; 3]>, corners: usize) -> Plc {
    Plc {
        vertices,
        facets: vec![facet(0..corners)],
        ..Plc::default()
    }
}

/// Doubles of integers.
fn doubles(points: impl IntoIterator<Item = [i32; 3]>) -> Vec<[f64; 3]> {
    points.into_iter().map(|p| p.map(f64::from)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::recover::polygons::{FlipOrder, Insertion};
    use tetflip::verify::{Domain, VerifyOptions, verify};

    #[test]
    fn every_subfamily_has_valid_members() {
        for member in Member::all(12) {
            let Prepared {
                plc,
                mut cdt,
                steiner_points,
            } = member.prepare();
            let mut report = Report::default();
            let insertion = Insertion::Flip(FlipOrder::FILTERED);
            let counts = cdt.insert_polygons(insertion, &mut report, &mut |_| ());
            let counts = counts.unwrap_or_else(|e| panic!("{member}: {e}"));
            assert_eq!(counts.not_flat, 0, "{member}");
            let mesh = cdt.export(&plc, true, &mut report).expect("a mesh");
            // Rounded Steiner points need the default tolerance.
            let default = VerifyOptions::default();
            let tolerance = if steiner_points > 0 {
                default.tolerance
            } else {
                0.0
            };
            let domain = Domain::Hull;
            let verdict = verify(
                &plc,
                &mesh,
                VerifyOptions {
                    domain,
                    tolerance,
                    ..default
                },
            );
            assert!(verdict.is_ok(), "{member}: {verdict}");
        }
    }

    /// A subfamily whose polygons are nearly always there already would ask nothing of flips.
    #[test]
    fn most_members_have_work_to_do() {
        let members = Member::all(40);
        let mut work = Vec::new();
        for family in &FAMILIES {
            for &subfamily in family.subfamilies {
                let mut flips = 0;
                let kind = (family.name, subfamily);
                let of_kind = |m: &&Member| (m.family(), m.subfamily()) == kind;
                for member in members.iter().filter(of_kind) {
                    let mut cdt = member.prepare().cdt;
                    let insertion = Insertion::Flip(FlipOrder::FILTERED);
                    let counts =
                        cdt.insert_polygons(insertion, &mut Report::default(), &mut |_| ());
                    flips += usize::from(counts.expect("exact order").flips.flips() > 1);
                }
                work.push((flips, kind));
            }
        }
        work.sort_unstable();
        assert!(work[0].0 >= 10, "of 40 members: {work:?}");
    }

    #[test]
    fn families_are_equally_large() {
        let members = Member::of_each_family(10);
        for family in &FAMILIES {
            let count = members.iter().filter(|m| m.family() == family.name).count();
            assert!(
                (10..10 + family.subfamilies.len()).contains(&count),
                "{}",
                family.name
            );
        }
        assert!(members.iter().all(|m| m.is_among_first(10)));
        assert!(members.iter().any(|m| !m.is_among_first(9)));
        assert_eq!(members[..40.min(members.len())], Member::all(2)[..40]);
    }

    #[test]
    fn names_are_parsed() {
        for member in Member::all(2) {
            assert_eq!(member.to_string().parse(), Ok(member));
        }
        for wrong in [
            "prism/right",
            "prism:1",
            "prism/left:1",
            "prisma/right:1",
            "prism/right:-1",
        ] {
            assert!(wrong.parse::<Member>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn facets_follow_their_vertices() {
        let mut draw = Draw::new(3, 0);
        let vertices: Vec<[f64; 3]> = (0..9).map(|_| draw.point()).collect();
        let mut plc = one_polygon(vertices.clone(), 4);
        shuffle_vertices(&mut plc, &mut draw);
        assert_ne!(plc.vertices, vertices);
        let polygon = &plc.facets[0].polygons[0];
        let corners: Vec<[f64; 3]> = polygon.iter().map(|v| plc.vertices[v.index()]).collect();
        assert_eq!(corners, vertices[..4]);
    }
}
