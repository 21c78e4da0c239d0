//! Sentences of the paper that say more than a number, and what in the results contradicts them.

/// A sentence.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What the paper says.
    pub sentence: String,
    /// The rows that say otherwise.
    pub contradictions: Vec<String>,
}

impl Claim {
    /// Whether nothing contradicts it.
    pub fn holds(&self) -> bool {
        self.contradictions.is_empty()
    }
}

impl std::fmt::Display for Claim {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let first = self
            .contradictions
            .iter()
            .take(5)
            .cloned()
            .collect::<Vec<_>>();
        write!(
            f,
            "the paper says that {}, but: {}",
            self.sentence,
            first.join("; ")
        )
    }
}
