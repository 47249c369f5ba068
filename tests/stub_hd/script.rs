//! What goes wrong when.
//!
//! The script is `stub_script`'s, or that of the environment variable `STUB_HD`: words between
//! commas, `@N` for the tick at which one acts.
//!
//! | word | does |
//! |---|---|
//! | `no_init` | no device opens (HD_COMM_ERROR) |
//! | `only=NAME` | only the device of this name opens (else HD_DEVICE_FAULT) |
//! | `bare` | the device says nothing of itself |
//! | `rate=HZ` | any other rate is refused (HD_INVALID_VALUE) |
//! | `grumble` | a rate is set, but with HD_TIMER_ERROR |
//! | `reset=N` | encoders are reset before the loop; the Nth time works, 0: never |
//! | `inkwell@N` | uncalibrated until tick N |
//! | `no_force`, `no_callback`, `no_start` | that is refused (HD_FORCE_ERROR, ..) |
//! | `mute` | the scheduler starts and never calls |
//! | `error=CODE@N` | this error at tick N |
//! | `frames@N` | HD_FRAME_ERROR in every tick from N on |
//! | `warm@N` | HD_WARM_MOTORS at tick N, warm motors for 1500 ticks |
//! | `stall=MS@N` | no call for so long |
//! | `slow=TICKSxMS@N` | so many periods of this length |
//! | `nan=TICKS@N` | the position is no number for so many ticks |
//! | `silent@N` | no call any more |

use super::Stub;
use std::time::Duration;

impl Stub {
    /// The words of the script, each with its argument and its tick.
    pub fn words(&self) -> Vec<(String, String, u64)> {
        let script = self.script.clone().or_else(|| std::env::var("STUB_HD").ok());
        let words = script.unwrap_or_default();
        let words = words.split(',').filter(|word| !word.is_empty()).map(|word| {
            let (word, tick) = word.split_once('@').unwrap_or((word, "0"));
            let (name, argument) = word.split_once('=').unwrap_or((word, ""));
            (name.to_string(), argument.to_string(), tick.parse().unwrap_or(0))
        });
        words.collect()
    }

    pub fn argument(&self, wanted: &str) -> Option<(String, u64)> {
        let words = self.words().into_iter();
        let mut found = words.filter(|(name, ..)| name == wanted);
        found.next().map(|(_, argument, tick)| (argument, tick))
    }

    pub fn has(&self, wanted: &str) -> bool {
        self.argument(wanted).is_some()
    }

    pub fn calibration(&self) -> u32 {
        let is_missing = match (self.argument("reset"), self.argument("inkwell")) {
            (Some((times, _)), _) => {
                let times = times.parse().unwrap_or(0);
                times == 0 || self.resets < times
            }
            (_, Some((_, until))) => self.tick < until,
            _ => false,
        };
        if is_missing { 0x5002 } else { 0x5000 }
    }

    /// What the script does at this tick. The pause before it.
    pub fn begin_tick(&mut self) -> Duration {
        self.tick += 1;
        self.frames_in_tick = 0;
        let (tick, mut pause) = (self.tick, 1000 / u64::from(self.rate_hz.max(1)).min(1000));
        for (name, argument, at) in self.words() {
            match name.as_str() {
                "error" if tick == at => {
                    let code = u32::from_str_radix(argument.trim_start_matches("0x"), 16);
                    self.fail(code.unwrap_or(0x300));
                }
                "frames" if tick >= at => self.fail(0x402),
                "warm" if tick == at => {
                    self.warm_until = tick + 1500;
                    self.fail(0x200);
                }
                "stall" if tick == at => pause = argument.parse().unwrap_or(50),
                "slow" => {
                    let (ticks, ms) = argument.split_once('x').unwrap_or(("5", "3"));
                    if (at..at + ticks.parse::<u64>().unwrap_or(5)).contains(&tick) {
                        pause = ms.parse().unwrap_or(3);
                    }
                }
                "silent" if tick == at => self.runs = false,
                _ => {}
            }
        }
        Duration::from_millis(pause)
    }

    pub fn is_nan(&self) -> bool {
        self.argument("nan").is_some_and(|(ticks, at)| {
            (at..at + ticks.parse::<u64>().unwrap_or(100)).contains(&self.tick)
        })
    }
}
