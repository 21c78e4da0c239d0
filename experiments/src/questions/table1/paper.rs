//! The numbers of the paper's Table 1 (page 16 of the proceedings' version), column by column. The row numbers are the
//! paper's.

/// One column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// The model.
    pub name: &'static str,
    /// (1)–(5) Input vertices, input polygons, Steiner points, output tetrahedra, output subpolygons.
    pub sizes: [usize; 5],
    /// (6)–(10) Recovered subpolygons, the most of them in a missing region, flips, crossing tetrahedra, the most of
    /// them in a missing region.
    pub regions: [u64; 5],
    /// (11) Crossing tetrahedra per missing region.
    pub mean_region: f64,
    /// (12)–(16) Seconds: Delaunay, segments, cavities, flips, all with cavities.
    pub seconds: [f64; 5],
}

const fn column(
    name: &'static str,
    sizes: [usize; 5],
    regions: [u64; 5],
    mean_region: f64,
    seconds: [f64; 5],
) -> Column {
    Column {
        name,
        sizes,
        regions,
        mean_region,
        seconds,
    }
}

/// The table.
#[rustfmt::skip]
pub const TABLE_1: [Column; 8] = [
    column("DEMO04", [1180, 2372, 2615, 11_810, 7602], [24, 9, 133, 169, 55], 28.0,
        [0.0685, 0.1332, 0.0255, 0.0254, 0.2449]),
    column("DEMO05", [1128, 2280, 1551, 7470, 5382], [25, 5, 206, 261, 49], 24.0,
        [0.0631, 0.0806, 0.0184, 0.0195, 0.1759]),
    column("anc101", [1378, 2772, 249, 5654, 3270], [60, 15, 386, 391, 63], 33.0,
        [0.0795, 0.0288, 0.0224, 0.0237, 0.1433]),
    column("monster4", [1392, 2784, 1024, 7198, 4832], [71, 11, 730, 860, 159], 41.0,
        [0.0724, 0.1399, 0.0432, 0.0440, 0.2701]),
    column("mohne-a", [2760, 5560, 6995, 27_956, 19_550], [41, 6, 296, 397, 100], 19.0,
        [0.1483, 0.3273, 0.0429, 0.0427, 0.5667]),
    column("thru-mazewheel", [2781, 5622, 749, 8378, 7120], [87, 15, 167, 266, 28], 7.0,
        [0.1496, 0.0436, 0.0293, 0.0285, 0.2476]),
    column("cognit", [2992, 5792, 8490, 39_386, 23_000], [148, 9, 232, 460, 23], 5.0,
        [0.0948, 0.3254, 0.0472, 0.0456, 0.5385]),
    column(
        "nasty_cheese",
        [8630, 17_782, 42_408, 149_757, 102_604], [112, 14, 290, 456, 54], 9.0,
        [1.4972, 3.1978, 0.2311, 0.2300, 5.3380],
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_consistent() {
        for Column {
            name,
            regions: [recovered, most_recovered, _, crossing, largest],
            seconds,
            ..
        } in TABLE_1
        {
            assert!(recovered >= most_recovered && crossing >= largest, "{name}");
            let [delaunay, segments, cavities, _, all] = seconds;
            assert!(delaunay + segments + cavities < all, "{name}");
        }
    }
}
