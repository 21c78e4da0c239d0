//! Tables by id that outlive one polygon, so that nothing of the size of the mesh is allocated or cleared per polygon.

/// A value for each id, the default until another is set. Clearing takes time proportional to what was set.
#[derive(Clone, Debug, Default)]
pub struct Table<V> {
    values: Vec<V>,
    /// The ids whose value has left the default at some time since the last clearing.
    touched: Vec<u32>,
}

impl<V: Copy + Default + PartialEq> Table<V> {
    /// The value of id `i`.
    #[inline]
    pub fn get(&self, i: usize) -> V {
        self.values.get(i).copied().unwrap_or_default()
    }

    /// Sets the value of id `i`.
    #[inline]
    pub fn set(&mut self, i: usize, value: V) {
        if i >= self.values.len() {
            self.values.resize(i + 1, V::default());
        }
        if self.values[i] == V::default() {
            self.touched.push(i as u32);
        }
        self.values[i] = value;
    }

    /// Sets the value of id `i` to the default.
    #[inline]
    pub fn reset(&mut self, i: usize) {
        if let Some(value) = self.values.get_mut(i) {
            *value = V::default();
        }
    }

    /// The ids that have a value other than the default, ascending.
    pub fn ids(&self) -> Vec<u32> {
        let set = |&i: &u32| self.values[i as usize] != V::default();
        let mut ids: Vec<u32> = self.touched.iter().copied().filter(set).collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    }

    /// Sets all values to the default.
    pub fn clear(&mut self) {
        for i in self.touched.drain(..) {
            self.values[i as usize] = V::default();
        }
    }
}

/// A set of ids that is emptied in no time.
#[derive(Clone, Debug, Default)]
pub(super) struct Stamps {
    stamps: Vec<u32>,
    current: u32,
}

impl Stamps {
    /// Empties the set; ids below `n` can be inserted.
    pub(super) fn clear(&mut self, n: usize) {
        if self.current == u32::MAX {
            self.stamps.fill(0);
            self.current = 0;
        }
        self.current += 1;
        if self.stamps.len() < n {
            // Not one by one where `n` grows with each call.
            self.stamps.resize(n + n / 8, 0);
        }
    }

    /// Whether i is in the set.
    #[inline]
    pub(super) fn contains(&self, i: usize) -> bool {
        self.stamps[i] == self.current
    }

    /// Inserts i; whether it is new.
    #[inline]
    pub(super) fn insert(&mut self, i: usize) -> bool {
        std::mem::replace(&mut self.stamps[i], self.current) != self.current
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cleared_stamps_are_empty() {
        let mut stamps = Stamps::default();
        stamps.clear(3);
        assert!(stamps.insert(2) && stamps.insert(0) && !stamps.insert(2));
        assert!(stamps.contains(2) && !stamps.contains(1));
        stamps.current = u32::MAX;
        stamps.insert(1);
        stamps.clear(4);
        assert!((0..4).all(|i| !stamps.contains(i)));
    }

    #[test]
    fn cleared_tables_are_empty() {
        let mut table = Table::default();
        for (i, value) in [(7, 1u8), (3, 2), (7, 3)] {
            table.set(i, value);
        }
        assert_eq!([table.get(3), table.get(7), table.get(100)], [2, 3, 0]);
        table.reset(3);
        table.reset(1000);
        assert_eq!(table.ids(), [7]);
        table.set(3, 5);
        assert_eq!(table.ids(), [3, 7]);
        table.clear();
        assert_eq!((table.get(3), table.get(7)), (0, 0));
        assert!(table.ids().is_empty());
    }
}
