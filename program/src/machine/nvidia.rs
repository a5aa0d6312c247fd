//! Facts from `nvidia-smi`, where it is installed. It is given little time: a driver in trouble makes it hang.

use std::{
    io::Read as _,
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use super::pci::{self, Address};

/// PCI's number for NVIDIA.
pub const VENDOR: u32 = 0x10de;

/// Some machines take a second to wake a card.
const TIME_OUT: Duration = Duration::from_secs(5);

/// A property of the card at `address`, such as `utilization.gpu`, with where the card is; without an address, of the only
/// one. `None` where there is no tool, no such card, or no number.
pub fn property(name: &str, address: Option<Address>) -> Option<(f64, Address)> {
    let text = answer("nvidia-smi", &[&format!("--query-gpu={name},pci.bus_id"), FORM], TIME_OUT)?;
    let (at, value) = pci::the_one(rows(&text), address)?;
    Some((value.parse().ok()?, at))
}

/// Processes other than this one that could compute on the card at `address`. In a container this one has another number
/// outside, so that it may be counted too.
pub fn other_processes(address: Address) -> Option<usize> {
    let text = answer("nvidia-smi", &["--query-compute-apps=pid,gpu_bus_id", FORM], TIME_OUT)?;
    let own = std::process::id().to_string();
    Some(rows(&text).filter(|(at, pid)| *at == address && *pid != own).count())
}

const FORM: &str = "--format=csv,noheader,nounits";

/// Lines such as `37, 00000000:65:00.0`.
fn rows(text: &str) -> impl Iterator<Item = (Address, &str)> {
    text.lines().filter_map(|line| {
        let (value, at) = line.rsplit_once(',')?;
        Some((pci::address(at)?, value.trim()))
    })
}

/// The output of a program; `None` where it can't be run, fails, or takes longer than `time_out`, which ends it.
fn answer(program: &str, arguments: &[&str], time_out: Duration) -> Option<String> {
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let begin = Instant::now();
    // A few lines fit the pipe, so that it may be read when all is over.
    let status = loop {
        match child.try_wait() {
            Ok(Some(status)) => break status,
            Ok(None) if begin.elapsed() < time_out => thread::sleep(Duration::from_millis(5)),
            Ok(None) | Err(_) => {
                // Either may fail where it has just ended by itself: there is nothing left to do then.
                let _ = child.kill();
                let _ = child.wait();
                return None;
            }
        }
    };
    let mut text = String::new();
    child.stdout.take()?.read_to_string(&mut text).ok()?;
    status.success().then_some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_read() {
        let text = "37, 00000000:65:00.0\n[N/A], 00000000:B3:00.0\nNo devices were found\n";
        let at = |bus| [0, bus, 0, 0];
        assert_eq!(rows(text).collect::<Vec<_>>(), [(at(0x65), "37"), (at(0xb3), "[N/A]")]);
        assert_eq!(pci::the_one(rows(text), Some(at(0x65))), Some((at(0x65), "37")));
        assert_eq!(pci::the_one(rows(text), None), None);
        assert_eq!(rows("").count(), 0);
    }

    #[cfg(unix)]
    #[test]
    fn a_tool_that_is_missing_fails_or_hangs_tells_nothing() {
        assert_eq!(answer("echo", &["37"], TIME_OUT).unwrap(), "37\n");
        assert_eq!(answer("surfel-has-no-such-tool", &[], TIME_OUT), None);
        assert_eq!(answer("sh", &["-c", "echo 37; exit 9"], TIME_OUT), None);
        let begin = Instant::now();
        assert_eq!(answer("sleep", &["60"], Duration::from_millis(50)), None);
        assert!(begin.elapsed() < Duration::from_secs(30));
    }
}
