//! A part of many inputs, for one of several machines.

use std::str::FromStr;

/// Part `index` (from 0) of `count` parts of a collection.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Shard {
    index: u64,
    count: u64,
}

impl Shard {
    /// Whether a model is in this part: by its name alone, so that it stays there when others are added.
    pub fn has(self, name: &str) -> bool {
        fnv1a(name.bytes()) % self.count == self.index
    }
}

impl FromStr for Shard {
    type Err = String;

    /// `1/4` is the first part of four.
    fn from_str(word: &str) -> Result<Shard, String> {
        let numbers = word
            .split_once('/')
            .and_then(|(i, n)| Some((i.parse::<u64>().ok()?, n.parse::<u64>().ok()?)));
        match numbers {
            Some((i, count)) if (1..=count).contains(&i) => Ok(Shard {
                index: i - 1,
                count,
            }),
            _ => Err("not I/N with 1 ≤ I ≤ N".to_owned()),
        }
    }
}

/// The hash of Fowler, Noll and Vo (variant 1a, 64 bits): the same on every machine and in every version, which hashers
/// for hash tables do not promise.
pub fn fnv1a(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_published_one() {
        assert_eq!(fnv1a(*b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(*b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a(*b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn every_model_is_in_one_shard() {
        let shards: Vec<Shard> = (1..=3)
            .map(|i| format!("{i}/3").parse().expect("a shard"))
            .collect();
        let mut sizes = [0; 3];
        for i in 0..300 {
            let name = format!("models/{i}.off");
            let homes: Vec<usize> = (0..3).filter(|&s| shards[s].has(&name)).collect();
            assert_eq!(homes.len(), 1);
            sizes[homes[0]] += 1;
        }
        assert!(sizes.iter().all(|&n| n > 60), "{sizes:?}");
        for word in ["0/3", "4/3", "1", "1/0", "a/b", "1/3/"] {
            assert!(word.parse::<Shard>().is_err(), "{word}");
        }
    }
}
