//! What the servo tells, as lines of a table.

use super::report::{ServoReport, Touched};
use crate::units::Seconds;
use std::fmt::Write;

/// The names of the columns, separated by commas.
pub const COLUMNS: &str = "tick,time_s,dt_s,device_x_m,device_y_m,device_z_m,device_speed_m_s,\
    buttons,tip_x_m,tip_y_m,tip_z_m,tip_speed_m_s,stabilised,azimuth_rad,elevation_rad,depth_m,\
    wanted_x_n,wanted_y_n,wanted_z_n,force_x_n,force_y_n,force_z_n,force_rms_n,energy_j,\
    stiffness_max_n_m,stiffness_factor,flags,late_s,contact,contact_speed_m_s,contact_impulse_ns";

/// The line of one tick that began `late_s` after its time; 0 where no clock runs.
pub fn row(report: &ServoReport, late_s: Seconds) -> String {
    let ServoReport { sample, wanted, force, .. } = report;
    let (device, tip) = (&sample.device, sample.tip);
    let mut line = String::with_capacity(400);
    let (touched, speed, impulse) = match &report.contact {
        None => (String::new(), 0.0, 0.0),
        Some(contact) => {
            let touched = match contact.touched {
                Touched::Struck(ball) => format!("struck {ball}"),
                Touched::Ball(ball) => format!("ball {ball}"),
                Touched::Face => String::from("face"),
            };
            (touched, contact.speed_m_s, contact.impulse.length())
        }
    };
    // Writing into a string does not fail.
    let _ = write!(
        line,
        "{},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6},{},{:.6},{:.6},{:.6},{:.6},{},{:.6},{:.6},{:.6},\
         {:.6},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6},{:.9},{:.1},{:.4},{},\
         {late_s:.9},{touched},{speed:.6},{impulse:.6}",
        sample.tick,
        report.time_s,
        sample.dt,
        device.position.x,
        device.position.y,
        device.position.z,
        device.velocity.length(),
        device.buttons.0,
        tip.x,
        tip.y,
        tip.z,
        sample.velocity.length(),
        u8::from(sample.stabilised),
        report.azimuth_rad,
        report.elevation_rad,
        report.depth_m,
        wanted.0.x,
        wanted.0.y,
        wanted.0.z,
        force.0.x,
        force.0.y,
        force.0.z,
        report.force_rms_n,
        report.energy_j,
        report.stiffness_max_n_m,
        report.stiffness_factor,
        report.flags.0,
    );
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haptic::ContactEvent;
    use crate::ids::BallId;
    use glam::DVec3;

    #[test]
    fn a_row_has_a_value_for_every_column() {
        let contact = ContactEvent {
            tick: 1,
            before_end_s: 0.0,
            touched: Touched::Struck(BallId::CUE),
            speed_m_s: 2.0,
            impulse: DVec3::X,
        };
        for contact in [None, Some(contact)] {
            let line = row(&ServoReport { contact, ..ServoReport::default() }, 1e-6);
            assert_eq!(line.split(',').count(), COLUMNS.split(',').count());
        }
    }
}
