//! One way of many to write a tetrahedralization down: what comes out of equal ones is equal.

use super::VertexId;

/// The even permutation of a tetrahedron that has its smallest vertex first and its second smallest second.
pub(crate) fn canonical_tet(mut v: [VertexId; 4]) -> [VertexId; 4] {
    let mut least = 0;
    for i in 1..4 {
        if v[i] < v[least] {
            least = i;
        }
    }
    // A double transposition brings it to the front and keeps the orientation.
    v = [v[least], v[least ^ 1], v[least ^ 2], v[least ^ 3]];
    let [a, b, c, d] = v;
    if b < c && b < d {
        v
    } else if c < d {
        [a, c, d, b]
    } else {
        [a, d, b, c]
    }
}

/// The rotation of a triangle that has its smallest vertex first.
pub(crate) fn canonical_face([a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn canonical_tetrahedra_keep_their_orientation() {
        let ids = |v: [u32; 4]| v.map(VertexId);
        assert_eq!(
            canonical_tet(ids([3, 1, 0, 2])),
            ids([0, 1, 2, 3]).map(|v| v)
        );
        // All even permutations of 0123 are one tetrahedron, all odd ones the other.
        let mut classes = std::collections::BTreeMap::new();
        for code in 0..256u32 {
            let v = [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6];
            let inversions = (0..4)
                .flat_map(|i| (i + 1..4).map(move |j| (i, j)))
                .filter(|&(i, j)| v[i] > v[j]);
            let odd = inversions.count() % 2;
            if (0..4).all(|x| v.contains(&x)) {
                classes
                    .entry(odd)
                    .or_insert_with(std::collections::BTreeSet::new)
                    .insert(canonical_tet(ids(v)));
            }
        }
        assert!(classes.values().all(|c| c.len() == 1));
        assert_eq!(classes.len(), 2);
    }
}
