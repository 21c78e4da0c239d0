//! The numbers of the paper's Table 1 (page 16 of the proceedings' version), column by column.

/// One column. The row numbers are the paper's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// The model.
    pub name: &'static str,
    /// (1) Input vertices.
    pub vertices: usize,
    /// (2) Input polygons.
    pub polygons: usize,
    /// (3) Steiner points.
    pub steiner_points: usize,
    /// (4) Output tetrahedra.
    pub tetrahedra: usize,
    /// (5) Output subpolygons.
    pub subpolygons: usize,
    /// (6) Recovered subpolygons.
    pub recovered: u64,
    /// (7) The most recovered subpolygons in a missing region.
    pub most_recovered: u64,
    /// (8) Flips.
    pub flips: u64,
    /// (9) Crossing tetrahedra.
    pub crossing_tets: u64,
    /// (10) The most crossing tetrahedra of a missing region.
    pub largest_region: u64,
    /// (11) Crossing tetrahedra per missing region.
    pub mean_region: f64,
    /// (12)–(16) Seconds: Delaunay, segments, cavities, flips, all with cavities.
    pub seconds: [f64; 5],
}

/// The table.
pub const TABLE_1: [Column; 8] = [
    column(
        "DEMO04",
        [1180, 2372, 2615, 11_810, 7602],
        [24, 9, 133, 169, 55],
        28.0,
        [0.0685, 0.1332, 0.0255, 0.0254, 0.2449],
    ),
    column(
        "DEMO05",
        [1128, 2280, 1551, 7470, 5382],
        [25, 5, 206, 261, 49],
        24.0,
        [0.0631, 0.0806, 0.0184, 0.0195, 0.1759],
    ),
    column(
        "anc101",
        [1378, 2772, 249, 5654, 3270],
        [60, 15, 386, 391, 63],
        33.0,
        [0.0795, 0.0288, 0.0224, 0.0237, 0.1433],
    ),
    column(
        "monster4",
        [1392, 2784, 1024, 7198, 4832],
        [71, 11, 730, 860, 159],
        41.0,
        [0.0724, 0.1399, 0.0432, 0.0440, 0.2701],
    ),
    column(
        "mohne-a",
        [2760, 5560, 6995, 27_956, 19_550],
        [41, 6, 296, 397, 100],
        19.0,
        [0.1483, 0.3273, 0.0429, 0.0427, 0.5667],
    ),
    column(
        "thru-mazewheel",
        [2781, 5622, 749, 8378, 7120],
        [87, 15, 167, 266, 28],
        7.0,
        [0.1496, 0.0436, 0.0293, 0.0285, 0.2476],
    ),
    column(
        "cognit",
        [2992, 5792, 8490, 39_386, 23_000],
        [148, 9, 232, 460, 23],
        5.0,
        [0.0948, 0.3254, 0.0472, 0.0456, 0.5385],
    ),
    column(
        "nasty_cheese",
        [8630, 17_782, 42_408, 149_757, 102_604],
        [112, 14, 290, 456, 54],
        9.0,
        [1.4972, 3.1978, 0.2311, 0.2300, 5.3380],
    ),
];

const fn column(
    name: &'static str,
    sizes: [usize; 5],
    regions: [u64; 5],
    mean_region: f64,
    seconds: [f64; 5],
) -> Column {
    Column {
        name,
        vertices: sizes[0],
        polygons: sizes[1],
        steiner_points: sizes[2],
        tetrahedra: sizes[3],
        subpolygons: sizes[4],
        recovered: regions[0],
        most_recovered: regions[1],
        flips: regions[2],
        crossing_tets: regions[3],
        largest_region: regions[4],
        mean_region,
        seconds,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_consistent() {
        for column in TABLE_1 {
            assert!(column.recovered >= column.most_recovered, "{}", column.name);
            assert!(column.crossing_tets >= column.largest_region);
            let [delaunay, segments, cavities, _, all] = column.seconds;
            assert!(delaunay + segments + cavities < all, "{}", column.name);
        }
    }
}
