//! The tables as comma-separated values and JSON.

use super::measure::{Measured, Timed};
use super::peers;
use super::stability::Table;
use hapticbillard::report::{Peers, Status};
use serde_json::{Value, json};
use std::fmt::Write;

/// A status in a word, with what there is to say about it.
pub fn status(status: &Status) -> (&'static str, String) {
    match status {
        Status::Ok => ("ok", String::new()),
        Status::Failed(failure) => ("failed", format!("at {:.4} s: {}", failure.at_s, failure.how)),
        Status::LeftOut(why) => ("left out", (*why).to_string()),
    }
}

/// A text as one field.
pub fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// A number, or nothing.
pub fn number(value: Option<f64>) -> String {
    value.map(|value| format!("{value:e}")).unwrap_or_default()
}

/// One line per row, under a head.
pub fn errors(measured: &[Measured], peers: Option<&Peers>) -> String {
    let mut text = String::from(
        "scene,method,step_ms,error_name,norm,unit,error,reference,reference_error,\
         observed_order,simulated_s,cpu_us_per_s_median,cpu_us_per_s_min,cpu_us_per_s_max,steps,\
         events,pair_tests,face_tests,contacts,force_evaluations,\
         flights,spins,pocket_tests,status,remark\n",
    );
    for scene in measured {
        let prepared = &scene.prepared;
        let reference = if prepared.closed_form() { "closed form" } else { "event-driven" };
        for Timed { row, cpu_us } in &scene.rows {
            let work = row.work;
            let (word, remark) = status(&row.status);
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{},{},{},position,{},m,{},{reference},\
                 {:e},{},{},{},{},{},{},{},{},{},{},{},{},{},{},\
                 {word},{}",
                row.scene,
                row.method.name(),
                row.method.step_ms().map(|step| step.to_string()).unwrap_or_default(),
                quoted(prepared.scene.norm.words()),
                number(row.error_m),
                prepared.reference_error_m,
                row.order.map(|order| format!("{order:.2}")).unwrap_or_default(),
                prepared.until_s,
                number(cpu_us.map(|cpu| cpu.median)),
                number(cpu_us.map(|cpu| cpu.least)),
                number(cpu_us.map(|cpu| cpu.most)),
                work.steps,
                work.events,
                work.pair_tests,
                work.face_tests,
                work.contacts,
                work.force_evaluations,
                work.flights,
                work.spins,
                work.pocket_tests,
                quoted(&remark),
            );
        }
        if let Some(peers) = peers {
            peers::csv(&mut text, scene, peers);
        }
    }
    text
}

/// One row.
pub fn json(timed: &Timed) -> Value {
    let Timed { row, cpu_us } = timed;
    let (word, remark) = status(&row.status);
    json!({
        "scene": row.scene,
        "method": row.method.name(),
        "step_ms": row.method.step_ms(),
        "error_m": row.error_m,
        "order": row.order,
        "cpu_us_per_s": cpu_us.map(|cpu| [cpu.median, cpu.least, cpu.most]),
        "work": row.work,
        "status": word,
        "remark": remark,
    })
}

/// One line per cell of the stability table.
pub fn stability(table: &Table) -> String {
    let mut text = String::from("case,method,step_ms,class,error,remark\n");
    for row in &table.rows {
        for (method, cell) in &row.cells {
            let step = method.step_ms().map(|step| step.to_string()).unwrap_or_default();
            let _ = writeln!(
                text,
                "{},{},{step},{},{:e},{}",
                row.id,
                method.name(),
                cell.class.word(),
                cell.error,
                quoted(&cell.note),
            );
        }
    }
    text
}
