//! What other programs made of the same cases, read from the file that `tests/peers` writes.

use super::catalogue::CATALOGUE;
use crate::hash::Digest;
use crate::one_line::without_place;
use serde::Deserialize;

/// What other programs made of the cases.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Peers {
    /// When and where they were measured.
    pub made: String,
    /// The programs, those that could not be installed too.
    pub programs: Vec<Program>,
    /// What each of them made of each case.
    pub rows: Vec<PeerRow>,
}

/// Another program.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Program {
    /// Its name.
    pub name: String,
    /// Its version, if it was installed.
    pub version: Option<String>,
    /// How it was set up, and where its laws are others.
    pub about: String,
    /// Why it was not run, if it was not.
    pub problem: Option<String>,
}

/// What a program made of a case with one setting.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PeerRow {
    /// The scene.
    pub scene: String,
    /// What was asked: [`SceneCase::digest`](super::SceneCase::digest).
    pub digest: Digest,
    /// The program.
    pub program: String,
    /// Its setting but for the step; may be empty.
    pub setting: String,
    /// Its step [ms], if it has one.
    pub step_ms: Option<f64>,
    /// How many starts were run.
    pub starts: usize,
    /// Median over the starts that were computed [m].
    pub error_m: Option<f64>,
    /// Processor time per simulated second: median, least and most [µs].
    pub cpu_us_per_s: Option<[f64; 3]>,
    /// What became of it.
    pub status: PeerStatus,
    /// Why, or what differs.
    pub remark: String,
}

/// What became of a case in another program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PeerStatus {
    /// Every start was computed.
    Ok,
    /// It ran, and failed.
    Failed,
    /// The program does not know what the case asks for.
    CannotExpress,
    /// It was not run.
    LeftOut,
}

impl PeerStatus {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            PeerStatus::Ok => "ok",
            PeerStatus::Failed => "failed",
            PeerStatus::CannotExpress => "cannot express",
            PeerStatus::LeftOut => "left out",
        }
    }
}

/// Why the results of other programs cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PeersError {
    /// The text is not what `tests/peers` writes.
    #[error("line {line}: {problem}")]
    Text {
        /// Where.
        line: usize,
        /// What is wrong.
        problem: String,
    },
    /// A row says what cannot be.
    #[error("row {row} ({program}, scene {scene}): {problem}")]
    Row {
        /// Its place, from 1.
        row: usize,
        /// Its program.
        program: String,
        /// Its scene.
        scene: String,
        /// What is wrong.
        problem: &'static str,
    },
}

impl PeerRow {
    /// The program with its setting.
    pub fn method(&self) -> String {
        if self.setting.is_empty() {
            return self.program.clone();
        }
        format!("{}, {}", self.program, self.setting)
    }

    /// Error [m] and processor time per simulated second [µs], if it ran well.
    pub fn point(&self) -> Option<(f64, f64)> {
        let [median, ..] = self.cpu_us_per_s?;
        (self.status == PeerStatus::Ok).then_some((self.error_m?, median))
    }

    fn problem(&self, programs: &[Program]) -> Option<&'static str> {
        let positive = |value: f64| value.is_finite() && 0.0 < value;
        let bad_error = |error: f64| !(error.is_finite() && 0.0 <= error);
        if !CATALOGUE.iter().any(|scene| scene.id == self.scene) {
            return Some("there is no such scene");
        }
        let ran = |program: &&Program| program.name == self.program && program.problem.is_none();
        if !programs.iter().any(|program| ran(&program)) {
            return Some("there is no such program that ran");
        }
        if self.step_ms.is_some_and(|step| !positive(step)) {
            return Some("its step is not above 0");
        }
        if self.error_m.is_some_and(bad_error) {
            return Some("its error is no length");
        }
        if self.cpu_us_per_s.is_some_and(|times| !times.into_iter().all(positive)) {
            return Some("its processor time is not above 0");
        }
        if self.status == PeerStatus::Ok && self.point().is_none() {
            return Some("it ran well but has no error or no processor time");
        }
        if self.status != PeerStatus::Ok && self.remark.is_empty() {
            return Some("it did not run well and does not say why");
        }
        None
    }
}

impl Peers {
    /// Reads the file's text.
    ///
    /// # Errors
    /// [`PeersError`] with the place of what is wrong.
    pub fn parse(text: &str) -> Result<Peers, PeersError> {
        let peers: Peers = serde_json::from_str(text).map_err(|error| PeersError::Text {
            line: error.line(),
            problem: without_place(&error),
        })?;
        for (at, row) in peers.rows.iter().enumerate() {
            if let Some(problem) = row.problem(&peers.programs) {
                let (program, scene) = (row.program.clone(), row.scene.clone());
                return Err(PeersError::Row { row: at + 1, program, scene, problem });
            }
        }
        Ok(peers)
    }

    /// The rows of a scene.
    pub fn of_scene<'a>(&'a self, scene: &'a str) -> impl Iterator<Item = &'a PeerRow> {
        self.rows.iter().filter(move |row| row.scene == scene)
    }

    /// The first row of a scene that was asked something else.
    pub fn stale(&self, scene: &str, digest: Digest) -> Option<&PeerRow> {
        self.rows.iter().find(|row| row.scene == scene && row.digest != digest)
    }
}

/// The rows that are at least as good as an error [m] for at most a processor time per simulated
/// second [µs], and better in one of the two: who keeps a method off the Pareto front of error
/// against run time.
pub fn cheaper_and_better<'a>(
    rows: impl Iterator<Item = &'a PeerRow>,
    error_m: f64,
    cpu_us_per_s: f64,
) -> Vec<&'a PeerRow> {
    let dominates = |row: &&PeerRow| {
        row.point().is_some_and(|(error, cost)| {
            error <= error_m && cost <= cpu_us_per_s && (error < error_m || cost < cpu_us_per_s)
        })
    };
    rows.filter(dominates).collect()
}
