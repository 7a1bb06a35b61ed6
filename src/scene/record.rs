//! What the first page of a record says about the work itself.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Project and people, for the first page of the record of an assessment. No answer depends on it;
/// what is absent is a blank line there.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Name or number of the project.
    pub project: Option<String>,
    /// Who made the assessment.
    pub author: Option<String>,
    /// Who checks it.
    pub checker: Option<String>,
    /// Revision, such as `B`.
    pub revision: Option<String>,
    /// Date of the revision, as it is to be read.
    pub date: Option<String>,
}

impl Record {
    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
