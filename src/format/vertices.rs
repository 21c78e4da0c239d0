//! Vertices with successive numbers, as TetGen's files list them.

use super::ahead::Rows;

/// The vertices read so far.
#[derive(Default)]
pub(super) struct Vertices {
    /// The number of the first one.
    first: Option<i64>,
    /// Whether these are from the middle of a list, so that the first may have any number.
    is_piece: bool,
    /// The coordinates.
    pub points: Vec<[f64; 3]>,
}

impl Vertices {
    /// The number that the next one must have, once there is one.
    pub fn expected(&self) -> Option<i64> {
        self.first?.checked_add(self.points.len() as i64)
    }

    /// Whether the next one may have the number: the first of a list has 0 or 1.
    pub fn may_have(&self, number: i64) -> bool {
        match self.first {
            None => self.is_piece || (0..=1).contains(&number),
            Some(_) => self.expected() == Some(number),
        }
    }

    /// Adds one.
    pub fn push(&mut self, number: i64, point: [f64; 3]) {
        self.first.get_or_insert(number);
        self.points.push(point);
    }

    /// The number of the first, 0 if there is none.
    pub fn first_index(&self) -> u32 {
        u32::from(self.first == Some(1))
    }
}

impl Rows for Vertices {
    fn piece(&self) -> Vertices {
        Vertices {
            is_piece: true,
            ..Vertices::default()
        }
    }

    fn len(&self) -> u64 {
        self.points.len() as u64
    }

    fn append(&mut self, next: Vertices) -> bool {
        let Some(number) = next.first else {
            return true;
        };
        let fits = self.may_have(number);
        if fits {
            self.first.get_or_insert(number);
            self.points.extend(next.points);
        }
        fits
    }
}
