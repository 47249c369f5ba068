//! Which device nodes this user may not use: the usual reason why a device that is plugged in is
//! not found.

/// The nodes under which the devices appear: FireWire, then two kinds of USB.
#[cfg(target_os = "linux")]
const NODES: [&str; 4] = ["fw", "raw1394", "ttyACM", "hidraw"];

/// A sentence about the nodes that are closed to this user, or that there are none.
#[cfg(target_os = "linux")]
pub fn hint() -> String {
    use crate::files::names_in;
    use rustix::fs::{Access, access};
    use std::path::Path;
    let is_open =
        |name: &str| access(format!("/dev/{name}"), Access::READ_OK | Access::WRITE_OK).is_ok();
    about(names_in(Path::new("/dev")), is_open)
}

/// Elsewhere nodes are the driver's own affair.
#[cfg(not(target_os = "linux"))]
pub fn hint() -> String {
    "is the device plugged in, switched on and set up with the vendor's program?".to_string()
}

#[cfg(target_os = "linux")]
fn about(mut names: Vec<String>, is_open: impl Fn(&str) -> bool) -> String {
    names.retain(|name| NODES.iter().any(|node| name.starts_with(node)));
    names.sort();
    if names.is_empty() {
        let nodes = NODES.map(|node| format!("/dev/{node}*")).join(", ");
        return format!("there is no device node ({nodes}): plug the device in and switch it on");
    }
    names.retain(|name| !is_open(name));
    if names.is_empty() {
        return "is the device switched on and set up with the vendor's program?".to_string();
    }
    let closed: Vec<String> = names.iter().map(|name| format!("/dev/{name}")).collect();
    format!(
        "this user may not read and write {}: if one of them is the device, install the vendor's \
         udev rules, or add the user to the group that owns it",
        closed.join(", ")
    )
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::about;

    #[test]
    fn closed_nodes_of_devices_are_named() {
        let names = ["ttyACM1", "null", "ttyACM0", "tty0"].map(String::from).to_vec();
        let told = about(names.clone(), |name| name == "ttyACM1");
        assert!(told.contains("read and write /dev/ttyACM0:"), "{told}");
        let told = about(names, |_| true);
        assert!(told.contains("switched on") && !told.contains("ttyACM"), "{told}");
        let told = about(vec!["null".into()], |_| false);
        assert!(
            told.contains("there is no device node") && told.contains("/dev/hidraw*"),
            "{told}"
        );
    }
}
