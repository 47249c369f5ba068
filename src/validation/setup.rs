//! The setup of one run, read by key.

use super::error::{CatalogueError, Trouble, unsupported};
use super::shapes::{
    BallEntry, BreakScene, CueEntry, Curve, Cylinder, Grid, MeshEntry, Numbers, Pause,
    RandomFrames, Repeat, Topspin, Wall,
};
use glam::DVec3;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// Most balls of a run.
const BALLS_MAX: usize = 20_000;
/// Longest run [s].
const END_MAX_S: f64 = 1e5;
/// Most frames and starts of a run, so that a file cannot ask for a year of work.
const FRAMES_MAX: f64 = 2e7;

/// The setup of one run and the law that it presumes.
pub(super) struct Setup<'c> {
    pub id: &'c str,
    pub law: &'c str,
    pub values: &'c Map<String, Value>,
}

impl Setup<'_> {
    pub fn error(&self, key: &str, problem: impl Into<String>, fix: &str) -> CatalogueError {
        CatalogueError::case(self.id, key, problem, fix)
    }

    pub fn get<T: DeserializeOwned>(&self, key: &str) -> Result<Option<T>, CatalogueError> {
        let Some(value) = self.values.get(key) else { return Ok(None) };
        match serde_json::from_value(value.clone()) {
            Ok(value) => Ok(Some(value)),
            Err(error) => Err(self.error(key, error.to_string(), "see another case with this key")),
        }
    }

    pub fn need<T>(&self, key: &str, value: Option<T>) -> Result<T, CatalogueError> {
        value.ok_or_else(|| self.error(key, "missing", "this kind of run needs it"))
    }

    /// A number that must be there.
    pub fn number(&self, key: &str) -> Result<f64, CatalogueError> {
        self.need(key, self.get(key)?)
    }

    /// A number, zero if it is not there.
    pub fn number_or_zero(&self, key: &str) -> Result<f64, CatalogueError> {
        Ok(self.get(key)?.unwrap_or(0.0))
    }

    /// A number that may be absent.
    pub fn maybe(&self, key: &str) -> Result<Option<f64>, CatalogueError> {
        self.get(key)
    }

    /// A number above zero.
    pub fn positive(&self, key: &str) -> Result<f64, CatalogueError> {
        let number = self.number(key)?;
        if number > 0.0 && number < 1e12 {
            Ok(number)
        } else {
            Err(self.error(key, format!("{number} is not above zero"), "write a positive number"))
        }
    }

    pub fn vector(&self, key: &str) -> Result<DVec3, CatalogueError> {
        self.need(key, self.get(key)?)
    }

    pub fn maybe_vector(&self, key: &str) -> Result<Option<DVec3>, CatalogueError> {
        self.get(key)
    }

    /// A unit vector.
    pub fn unit(&self, key: &str) -> Result<DVec3, CatalogueError> {
        self.check_unit(key, self.vector(key)?)
    }

    fn check_unit(&self, key: &str, vector: DVec3) -> Result<DVec3, CatalogueError> {
        if (vector.length() - 1.0).abs() < 1e-6 {
            Ok(vector.normalize())
        } else {
            Err(self.error(key, format!("{vector} is no unit vector"), "divide it by its length"))
        }
    }

    pub fn switch(&self, key: &str) -> Result<bool, CatalogueError> {
        Ok(self.get(key)?.unwrap_or(false))
    }

    pub fn word(&self, key: &str) -> Result<String, CatalogueError> {
        self.need(key, self.get(key)?)
    }

    pub fn count(&self, key: &str) -> Result<Option<u64>, CatalogueError> {
        self.get(key)
    }

    pub fn counts(&self, key: &str) -> Result<Option<Vec<u32>>, CatalogueError> {
        self.get(key)
    }

    /// One number or several; none if the key is not there.
    pub fn numbers(&self, key: &str) -> Result<Vec<f64>, CatalogueError> {
        Ok(self.get::<Numbers>(key)?.map_or(Vec::new(), Numbers::list))
    }

    /// A pair of numbers.
    pub fn two(&self, key: &str) -> Result<[f64; 2], CatalogueError> {
        self.need(key, self.get(key)?)
    }

    /// The end of the run [s].
    pub fn end_s(&self) -> Result<f64, CatalogueError> {
        let end = self.number("end_time_s")?;
        if (0.0..=END_MAX_S).contains(&end) {
            return Ok(end);
        }
        let problem = format!("{end} s is no time to run to");
        Err(self.error("end_time_s", problem, "write a time from 0 to 1e5 s"))
    }

    /// The lengths of frames that are asked for [s]; none: the runner's own.
    pub fn frames_s(&self, end_s: f64) -> Result<Vec<f64>, CatalogueError> {
        let frames = self.numbers("frame_s")?;
        for frame in &frames {
            if !(*frame > 0.0 && end_s / frame <= FRAMES_MAX) {
                let problem = format!("{frame} s is no length of a frame");
                return Err(self.error("frame_s", problem, "write a positive time, not too short"));
            }
        }
        Ok(frames)
    }

    pub fn balls(&self) -> Result<Vec<BallEntry>, CatalogueError> {
        let balls: Vec<BallEntry> = self.get("balls")?.unwrap_or_default();
        let wrong = |problem: String, fix| Err(self.error("balls", problem, fix));
        if balls.is_empty() || balls.len() > BALLS_MAX {
            return wrong(format!("{} balls", balls.len()), "list 1 to 20000 balls");
        }
        let mut ids: Vec<i64> = balls.iter().map(|ball| ball.id).collect();
        ids.sort_unstable();
        if let Some(twice) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
            return wrong(format!("two balls have the id {}", twice[0]), "give each its own");
        }
        for ball in &balls {
            let inertia = ball.inertia_factor.unwrap_or(1.0);
            let sizes = [ball.m, ball.radius_m, inertia];
            if !sizes.iter().all(|size| *size > 0.0 && size.is_finite()) {
                let problem = format!("ball {} has no positive mass, radius or inertia", ball.id);
                return wrong(problem, "write positive numbers");
            }
        }
        Ok(balls)
    }

    /// The only ball of a run.
    pub fn ball(&self) -> Result<BallEntry, CatalogueError> {
        let mut balls = self.balls()?;
        match balls.pop() {
            Some(ball) if balls.is_empty() => Ok(ball),
            _ => Err(self.error("balls", "this kind of run has one ball", "list one ball")),
        }
    }

    /// The two balls of a run.
    pub fn pair(&self) -> Result<[BallEntry; 2], CatalogueError> {
        let wrong = |_| self.error("balls", "this kind of run has two balls", "list two balls");
        self.balls()?.try_into().map_err(wrong)
    }

    pub fn walls(&self) -> Result<Vec<Wall>, CatalogueError> {
        let mut walls: Vec<Wall> = self.get("walls")?.unwrap_or_default();
        for wall in &mut walls {
            wall.normal = self.check_unit("walls", wall.normal)?;
        }
        Ok(walls)
    }

    pub fn plane(&self) -> Result<Wall, CatalogueError> {
        let level = Wall { point_m: DVec3::ZERO, normal: DVec3::Z };
        let mut plane = self.get("plane")?.unwrap_or(level);
        plane.normal = self.check_unit("plane", plane.normal)?;
        Ok(plane)
    }

    pub fn cylinders(&self) -> Result<Vec<Cylinder>, CatalogueError> {
        let mut cylinders: Vec<Cylinder> = self.get("cylinders")?.unwrap_or_default();
        for cylinder in &mut cylinders {
            cylinder.axis = self.check_unit("cylinders", cylinder.axis)?;
        }
        Ok(cylinders)
    }

    pub fn mesh(&self) -> Result<MeshEntry, CatalogueError> {
        let mesh: MeshEntry = self.need("mesh", self.get("mesh")?)?;
        let count = mesh.vertices_m.len() as u64;
        let outside = |corner: &u32| u64::from(*corner) >= count;
        if let Some(corner) = mesh.triangles.iter().flatten().find(|corner| outside(corner)) {
            let problem = format!("a triangle names vertex {corner} of {count}");
            return Err(self.error("mesh", problem, "vertices are numbered from 0"));
        }
        Ok(mesh)
    }

    pub fn repeat(&self) -> Result<Option<Repeat>, CatalogueError> {
        let repeat: Option<Repeat> = self.get("repeat")?;
        match repeat {
            Some(repeat) if !(1..=1_000_000).contains(&repeat.count) => {
                let problem = format!("a count of {}", repeat.count);
                Err(self.error("repeat", problem, "write a count from 1 to 1000000"))
            }
            repeat => Ok(repeat),
        }
    }

    pub fn grid(&self) -> Result<Option<Grid>, CatalogueError> {
        let grid: Option<Grid> = self.get("balls_grid")?;
        let Some(grid) = grid else { return Ok(None) };
        let count = grid.count.iter().map(|n| u64::from(*n)).product::<u64>();
        let real = grid.m > 0.0 && grid.radius_m > 0.0;
        if !real || !(1..=BALLS_MAX as u64).contains(&count) {
            let problem = format!("{count} balls of {} kg and {} m", grid.m, grid.radius_m);
            return Err(self.error("balls_grid", problem, "write 1 to 20000 real balls"));
        }
        Ok(Some(grid))
    }

    pub fn cue(&self) -> Result<CueEntry, CatalogueError> {
        let mut cue: CueEntry = self.need("cue", self.get("cue")?)?;
        cue.direction = self.check_unit("cue", cue.direction)?;
        Ok(cue)
    }

    pub fn curve(&self) -> Result<Option<Curve>, CatalogueError> {
        self.get("mu_curve")
    }

    pub fn random_frames(&self, end_s: f64) -> Result<Option<RandomFrames>, CatalogueError> {
        let frames: Option<RandomFrames> = self.get("random_frames")?;
        match frames {
            Some(frames)
                if !(0.0 < frames.min_s && frames.min_s < frames.max_s)
                    || end_s / frames.min_s > FRAMES_MAX =>
            {
                let problem = format!("from {} to {} s", frames.min_s, frames.max_s);
                Err(self.error("random_frames", problem, "write 0 < min_s < max_s, not too short"))
            }
            frames => Ok(frames),
        }
    }

    pub fn pause(&self) -> Result<Option<Pause>, CatalogueError> {
        let pause: Option<Pause> = self.get("pause")?;
        match pause {
            Some(pause) if pause.steps > 100_000 => {
                let problem = format!("{} frames without time", pause.steps);
                Err(self.error("pause", problem, "write at most 100000 steps"))
            }
            pause => Ok(pause),
        }
    }

    pub fn contacts(&self) -> Result<Vec<[i64; 2]>, CatalogueError> {
        Ok(self.get("contacts")?.unwrap_or_default())
    }

    pub fn break_scene(&self) -> Result<Option<BreakScene>, CatalogueError> {
        self.get("break_scene")
    }

    pub fn topspin(&self) -> Result<Topspin, CatalogueError> {
        self.need("topspin_over_rolling", self.get("topspin_over_rolling")?)
    }

    /// The two ends of a range, the lower first.
    pub fn range(&self, key: &str) -> Result<std::ops::Range<f64>, CatalogueError> {
        let [low, high] = self.two(key)?;
        if low < high && high.is_finite() {
            return Ok(low..high);
        }
        Err(self.error(key, format!("from {low} to {high} is no range"), "write [low, high]"))
    }

    /// Gravity along −z [m/s²].
    pub fn gravity(&self) -> Result<f64, Trouble> {
        let gravity = self.maybe_vector("gravity_m_s2")?.unwrap_or_default();
        if gravity.x == 0.0 && gravity.y == 0.0 && gravity.z <= 0.0 {
            Ok(-gravity.z)
        } else {
            unsupported("gravity acts along -z in this build")
        }
    }

    /// Reads every key once, so that what is wrong is said before anything runs.
    pub fn check(&self) -> Result<(), CatalogueError> {
        for key in self.values.keys() {
            match key.as_str() {
                "balls" if self.values["balls"].is_array() => drop(self.balls()?),
                "balls" | "faces" | "delay_samples" | "phases" | "ticks" => drop(self.count(key)?),
                "walls" => drop(self.walls()?),
                "plane" => drop(self.plane()?),
                "cylinders" => drop(self.cylinders()?),
                "mesh" => drop(self.mesh()?),
                "repeat" => drop(self.repeat()?),
                "balls_grid" => drop(self.grid()?),
                "cue" => drop(self.cue()?),
                "mu_curve" => drop(self.curve()?),
                "random_frames" => drop(self.random_frames(0.0)?),
                "pause" => drop(self.pause()?),
                "contacts" => drop(self.contacts()?),
                "break_scene" => drop(self.break_scene()?),
                "subdivisions" => drop(self.counts(key)?),
                "seeds" | "shots" => drop(self.count(key)?),
                "topspin_over_rolling" => drop(self.topspin()?),
                "hand" => drop(self.hand()?),
                "push" => drop(self.push()?),
                "transient" => drop(self.transient()?),
                key if key.contains("_range_") || key == "f_band" => {
                    self.range(key)?;
                }
                "hit_counts_outliers" => drop(self.switch(key)?),
                "two_sided" => drop(self.switch(key)?),
                "profile" | "law" | "limit_of" => drop(self.word(key)?),
                "gravity_m_s2" | "mirror_normal" | "axis" => drop(self.vector(key)?),
                "mass_kg" | "velocity_start_m_s" | "sample_time_s" | "frame_s" | "K_test_N_m" => {
                    drop(self.numbers(key)?);
                }
                "end_time_s" => drop(self.end_s()?),
                _ => drop(self.number(key)?),
            }
        }
        Ok(())
    }
}
