//! Which tetrahedra contain a point: all the points that are asked for at once. A tree of the points is searched with
//! the bounding box of each tetrahedron, and what it finds is decided exactly.
//!
//! For n tetrahedra and m points: O(m log m) for the tree, and O(log m) for each tetrahedron of reasonable shape.

use crate::mesh::VertexId;
use crate::threads;
use crate::verify::lookup::tables::{INWARD, Tables};
use crate::verify::signs::points::Points;
use rustc_hash::FxHashMap;
use std::ops::Range;

const LEAF: usize = 6;

/// Fewer tetrahedra are one thread's work.
const FEW: usize = 1 << 14;

/// A box by its least and greatest coordinates.
type Bounds = [[f64; 3]; 2];

struct Node {
    /// Of the points below, with their slack.
    bounds: Bounds,
    /// The range of points below this node.
    range: [u32; 2],
    /// The second child; the first one is the next node. 0 for a leaf.
    second: u32,
}

/// A point of the tree.
#[derive(Clone, Copy)]
struct Site {
    /// Rounded.
    at: [f64; 3],
    /// How far off that may be along each axis.
    slack: f64,
    query: u32,
}

/// The centroid of vertices.
struct Query {
    /// The vertices, one to four; the rest are [`VertexId::INFINITE`].
    vertices: [VertexId; 4],
    /// A tetrahedron that is known to contain it and not asked for, or none ([`u32::MAX`]).
    own: u32,
}

/// Points and the tetrahedra that contain them.
pub(crate) struct Locator<'a> {
    points: &'a Points,
    tables: &'a Tables<'a>,
    /// The tetrahedra that contain single points.
    around: FxHashMap<VertexId, Vec<usize>>,
}

/// (f, t) for the tetrahedra t whose closure contains the centroid of the boundary face f, besides that of the face.
pub(crate) fn around_faces(
    points: &Points,
    tables: &Tables,
    boundary: &[usize],
) -> Vec<(usize, usize)> {
    let faces = boundary.iter().map(|&f| {
        let face = &tables.faces[f];
        let [a, b, c] = face.key;
        Query {
            vertices: [a, b, c, VertexId::INFINITE],
            own: face.first().tet() as u32,
        }
    });
    let found = pairs(points, tables, &faces.collect::<Vec<_>>());
    let names = found.into_iter();
    names
        .map(|(query, t)| (boundary[query as usize], t as usize))
        .collect()
}

/// The tetrahedra whose closure contains the centroid of the first one, besides this, in increasing order.
pub(crate) fn around_first(points: &Points, tables: &Tables) -> Vec<usize> {
    let query = Query {
        vertices: tables.tets[0],
        own: 0,
    };
    let found = pairs(points, tables, &[query]);
    found.into_iter().map(|(_, t)| t as usize).collect()
}

/// (query, tetrahedron) for all that contain the point of a query and are not its own, in order of queries, then of
/// tetrahedra.
fn pairs(points: &Points, tables: &Tables, queries: &[Query]) -> Vec<(u32, u32)> {
    if queries.is_empty() {
        return Vec::new();
    }
    let mut pairs = Search::new(points, queries).pairs(points, tables, queries);
    pairs.sort_by_key(|&(query, _)| query);
    pairs
}

impl<'a> Locator<'a> {
    /// Locates the `singles`.
    pub(crate) fn new(
        points: &'a Points,
        tables: &'a Tables,
        singles: impl Iterator<Item = VertexId>,
    ) -> Locator<'a> {
        let none = VertexId::INFINITE;
        let query = |v| Query {
            vertices: [v, none, none, none],
            own: u32::MAX,
        };
        let queries: Vec<Query> = singles.map(query).collect();
        let mut around: FxHashMap<VertexId, Vec<usize>> = FxHashMap::default();
        for query in &queries {
            around.insert(query.vertices[0], Vec::new());
        }
        for (query, t) in pairs(points, tables, &queries) {
            let found = around
                .entry(queries[query as usize].vertices[0])
                .or_default();
            // A point that was asked for twice.
            if !found.contains(&(t as usize)) {
                found.push(t as usize);
            }
        }
        Locator {
            points,
            tables,
            around,
        }
    }

    /// The tetrahedra whose closure contains a point that was asked for, in increasing order.
    pub(crate) fn containing(&self, v: VertexId) -> &[usize] {
        self.around.get(&v).expect("a point that was located")
    }

    /// Whether a short step from the vertex v in the direction (u−v) + (w−v) stays in a tetrahedron (or its
    /// boundary). A face of the tetrahedron through v has v on its plane, so that orient(face, v + d) is the sum of
    /// orient(face, u) and orient(face, w).
    pub(crate) fn enters(&self, v: VertexId, toward: &[VertexId]) -> bool {
        self.tables.star(v).iter().any(|&t| {
            let tet = self.tables.tets[t as usize];
            (0..4).filter(|&i| tet[i] != v).all(|i| {
                !self
                    .points
                    .side(INWARD[i].map(|k| tet[k]), toward)
                    .is_negative()
            })
        })
    }
}

/// A tree of the points.
struct Search {
    nodes: Vec<Node>,
    sites: Vec<Site>,
}

impl Query {
    fn vertices(&self) -> &[VertexId] {
        let end = self.vertices.iter().position(|v| v.is_infinite());
        &self.vertices[..end.unwrap_or(4)]
    }

    fn site(&self, points: &Points, query: usize) -> Site {
        let vertices = self.vertices();
        let (at, slack) = points.centroid(vertices);
        Site {
            at,
            slack,
            query: query as u32,
        }
    }
}

impl Search {
    fn new(points: &Points, queries: &[Query]) -> Search {
        let sites = queries.iter().enumerate();
        let mut search = Search {
            nodes: Vec::new(),
            sites: sites.map(|(i, query)| query.site(points, i)).collect(),
        };
        let all = search.sites.len();
        search.split(0, all);
        search
    }

    fn split(&mut self, from: usize, to: usize) {
        let members = &mut self.sites[from..to];
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for site in members.iter() {
            for i in 0..3 {
                low[i] = low[i].min(site.at[i] - site.slack);
                high[i] = high[i].max(site.at[i] + site.slack);
            }
        }
        let node = self.nodes.len();
        self.nodes.push(Node {
            bounds: [low, high],
            range: [from as u32, to as u32],
            second: 0,
        });
        if members.len() <= LEAF {
            return;
        }
        let axis = (0..3)
            .max_by(|&i, &j| (high[i] - low[i]).total_cmp(&(high[j] - low[j])))
            .expect("three axes");
        let middle = members.len() / 2;
        members.select_nth_unstable_by(middle, |s, t| {
            s.at[axis]
                .total_cmp(&t.at[axis])
                .then(s.query.cmp(&t.query))
        });
        self.split(from, from + middle);
        self.nodes[node].second = self.nodes.len() as u32;
        self.split(from + middle, to);
    }

    /// (query, tetrahedron) for all tetrahedra that contain the point of a query and are not its own; the tetrahedra in
    /// increasing order.
    fn pairs(&self, points: &Points, tables: &Tables, queries: &[Query]) -> Vec<(u32, u32)> {
        let parts = threads::in_parts(tables.tets.len(), FEW, |range| {
            let mut pairs = Vec::new();
            self.pairs_of(range, points, tables, queries, &mut pairs);
            pairs
        });
        parts.concat()
    }

    /// The same for some of the tetrahedra.
    fn pairs_of(
        &self,
        range: Range<usize>,
        points: &Points,
        tables: &Tables,
        queries: &[Query],
        pairs: &mut Vec<(u32, u32)>,
    ) {
        let mut stack = Vec::new();
        for (t, &tet) in range.clone().zip(&tables.tets[range]) {
            let wobble = points.wobble(&tet);
            let mut low = points.at(tet[0]);
            let mut high = low;
            for v in &tet[1..] {
                let p = points.at(*v);
                for i in 0..3 {
                    low[i] = if p[i] < low[i] { p[i] } else { low[i] };
                    high[i] = if p[i] > high[i] { p[i] } else { high[i] };
                }
            }
            for i in 0..3 {
                low[i] -= wobble;
                high[i] += wobble;
            }
            stack.push(0);
            while let Some(n) = stack.pop() {
                let node: &Node = &self.nodes[n as usize];
                let [least, greatest] = &node.bounds;
                if (0..3).any(|i| greatest[i] < low[i] || least[i] > high[i]) {
                    continue;
                }
                if node.second > 0 {
                    stack.extend([node.second, n + 1]);
                    continue;
                }
                for site in &self.sites[node.range[0] as usize..node.range[1] as usize] {
                    let Site { at, slack, query } = *site;
                    if (0..3).any(|i| at[i] + slack < low[i] || at[i] - slack > high[i]) {
                        continue;
                    }
                    let asked = &queries[query as usize];
                    if asked.own != t as u32
                        && points.contains(tet, &INWARD, asked.vertices(), (at, slack))
                    {
                        pairs.push((query, t as u32));
                    }
                }
            }
        }
    }
}
