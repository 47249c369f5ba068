//! What can be wrong with a catalogue, and what can keep a run from its end.

use crate::physics::PhysicsError;

/// A catalogue cannot be read; one line that names case and key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CatalogueError {
    /// It is no JSON.
    #[error("no JSON: {0}; check the file with a JSON tool")]
    Json(String),
    /// It is JSON, but no catalogue.
    #[error("{key}: {problem}; {fix}")]
    Shape {
        /// The key at the top of the file.
        key: String,
        /// What is wrong with it.
        problem: String,
        /// What to do.
        fix: String,
    },
    /// A case is wrong.
    #[error("case {id}, key {key}: {problem}; {fix}")]
    Case {
        /// The case.
        id: String,
        /// Its key.
        key: String,
        /// What is wrong with it.
        problem: String,
        /// What to do.
        fix: String,
    },
}

impl CatalogueError {
    pub(super) fn shape(key: &str, problem: impl Into<String>, fix: &str) -> Self {
        Self::Shape { key: one_line(key), problem: one_line(&problem.into()), fix: fix.into() }
    }

    pub(super) fn case(id: &str, key: &str, problem: impl Into<String>, fix: &str) -> Self {
        Self::Case {
            id: one_line(id),
            key: one_line(key),
            problem: one_line(&problem.into()),
            fix: fix.into(),
        }
    }
}

/// What came from the file, fit for one line of a message.
pub(super) fn one_line(text: &str) -> String {
    let clean = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    clean.take(300).collect()
}

/// Why a run has no result.
#[derive(Debug)]
pub(super) enum Trouble {
    /// This build cannot do what the case asks for.
    Unsupported(String),
    /// It was run, and did not get through.
    Failed(String),
    /// The case is wrong.
    Wrong(CatalogueError),
}

impl From<CatalogueError> for Trouble {
    fn from(error: CatalogueError) -> Self {
        Trouble::Wrong(error)
    }
}

impl From<PhysicsError> for Trouble {
    fn from(error: PhysicsError) -> Self {
        Trouble::Failed(error.to_string())
    }
}

/// The case asks for something that this build does not have.
pub(super) fn unsupported<T>(why: impl Into<String>) -> Result<T, Trouble> {
    Err(Trouble::Unsupported(why.into()))
}
