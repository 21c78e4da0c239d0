//! The numbers of the paper's Table 2 (page 17 of the proceedings' version), in per cent.

/// One column: rows (1) to (4) of the cavity algorithm, (5) and (6) of the flip algorithm.
pub const TABLE_2: [(&str, [f64; 6]); 8] = [
    ("DEMO04", [74.7, 8.5, 0.7, 3.4, 65.8, 25.5]),
    ("DEMO05", [72.5, 9.2, 0.9, 4.0, 70.3, 23.9]),
    ("anc101", [79.0, 6.5, 0.5, 2.4, 64.4, 29.1]),
    ("monster4", [80.0, 7.1, 0.3, 2.0, 64.2, 28.3]),
    ("mohne-a", [72.1, 8.4, 1.0, 5.0, 58.6, 33.4]),
    ("thru-mazewheel", [66.4, 11.2, 1.9, 5.3, 61.2, 28.5]),
    ("cognit", [60.5, 11.2, 2.5, 7.3, 55.5, 31.3]),
    ("nasty_cheese", [59.2, 11.0, 1.7, 6.8, 48.6, 34.3]),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::questions::table1::paper::TABLE_1;

    /// The tasks of each algorithm take most of its time, and not more than all.
    #[test]
    fn the_parts_make_a_whole() {
        for ((model, shares), column) in TABLE_2.iter().zip(TABLE_1) {
            assert_eq!(*model, column.name);
            let cavities = shares[..4].iter().sum::<f64>();
            assert!((78.0..91.0).contains(&cavities), "{model}: {cavities}");
            let flips = shares[4] + shares[5];
            assert!((82.0..95.0).contains(&flips), "{model}: {flips}");
        }
    }
}
