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

#[cfg(test)]
mod tests {
    use super::*;

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
