//! What a runner saw.

use glam::DVec3;
use std::collections::BTreeMap;

/// A value that a runner computed.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Observed {
    /// A number.
    Number(f64),
    /// A whole number that must be met exactly unless the case says otherwise.
    Count(u64),
    /// True or false.
    Truth(bool),
    /// Components that are compared on the scale of the largest.
    Vector(Vec<f64>),
    /// Several values: one a ball, one an impact.
    List(Vec<Observed>),
}

impl From<f64> for Observed {
    fn from(number: f64) -> Self {
        Observed::Number(number)
    }
}

impl From<bool> for Observed {
    fn from(truth: bool) -> Self {
        Observed::Truth(truth)
    }
}

impl From<DVec3> for Observed {
    fn from(vector: DVec3) -> Self {
        Observed::Vector(vector.to_array().to_vec())
    }
}

impl<T: Into<Observed>> From<Vec<T>> for Observed {
    fn from(list: Vec<T>) -> Self {
        Observed::List(list.into_iter().map(Into::into).collect())
    }
}

/// Everything that a run showed, by expect key. What never happened is not there.
#[derive(Debug, Default)]
pub(super) struct Observations(BTreeMap<&'static str, Observed>);

impl Observations {
    /// Adds a value.
    pub fn set(&mut self, key: &'static str, value: impl Into<Observed>) {
        self.0.insert(key, value.into());
    }

    /// Adds a value, if there is one.
    pub fn maybe(&mut self, key: &'static str, value: Option<impl Into<Observed>>) {
        if let Some(value) = value {
            self.set(key, value);
        }
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Observed> {
        self.0.get(key)
    }
}

/// Degrees of an angle in radians.
pub(super) fn degrees(radians: f64) -> f64 {
    radians * (180.0 / core::f64::consts::PI)
}

/// The angle between two vectors [rad]; exact for small ones too.
pub(super) fn angle_between(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b))
}
