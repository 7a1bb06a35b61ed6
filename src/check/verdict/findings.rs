//! What a check says: what holds and what does not, each with its number.

use super::exact::Grade;

/// What the recomputation gave, one line of text each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// What holds, with its number.
    pub holds: Vec<String>,
    /// What does not, with its number.
    pub fails: Vec<String>,
    /// What would have to be computed again and could not be, for this build has no solver.
    pub unchecked: Vec<String>,
    /// How exactly: the weakest of all that holds.
    pub grade: Grade,
    /// Whether something in it is computed, not proved.
    pub computed: bool,
}

impl Findings {
    pub(in crate::verdict) fn require(&mut self, ok: bool, text: String) {
        if ok { &mut self.holds } else { &mut self.fails }.push(text);
    }

    /// Requires something that is proved with a grade.
    pub(in crate::verdict) fn require_graded(
        &mut self,
        ok: bool,
        grade: Grade,
        text: impl std::fmt::Display,
    ) {
        self.grade = self.grade.and(grade);
        self.require(ok, format!("{text} ({grade})"));
    }

    /// Adds what another check found.
    pub fn and(&mut self, other: &Self) {
        self.holds.extend_from_slice(&other.holds);
        self.fails.extend_from_slice(&other.fails);
        self.unchecked.extend_from_slice(&other.unchecked);
        self.grade = self.grade.and(other.grade);
        self.computed |= other.computed;
    }

    /// Whether the claim is proved.
    pub fn proved(&self) -> bool {
        self.fails.is_empty() && !self.holds.is_empty()
    }
}
