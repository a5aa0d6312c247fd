//! The state of the machine while something is measured, as far as the system tells: Linux's `/proc` and `/sys`, and
//! `nvidia-smi` where it is installed. Elsewhere nothing is known, and said so.

mod card;
mod nvidia;
mod pci;

use std::{fs, path::Path, thread};

use surfel::{
    report::{
        Spread,
        bench::{CardUse, Machine},
    },
    vk::{DeviceFacts, DeviceKind},
};

/// The state at the begin of a measurement.
pub struct Watch<'a> {
    facts: &'a DeviceFacts,
    times: Option<Times>,
    card: Option<CardUse>,
}

/// Clock ticks of the processor's threads together.
#[derive(Clone, Copy)]
struct Times {
    all: u64,
    busy: u64,
    own: u64,
}

impl<'a> Watch<'a> {
    /// Begins to watch. Nothing may be under way on the device.
    pub fn begin(facts: &'a DeviceFacts) -> Self {
        let card = card::before(facts);
        Self { facts, times: Times::now(), card }
    }

    /// The state seen till now. `clocks_mhz` were taken while the device worked: idle ones are slow, and tell nothing.
    pub fn end(&self, clocks_mhz: &[f64]) -> Machine {
        // A graphics card may be shared whatever the processor does, and is not by what the processor does.
        let is_processor = self.facts.kind == DeviceKind::Cpu;
        let taken_by_others =
            self.times.filter(|_| is_processor).zip(Times::now()).and_then(|(begin, end)| {
                let all = end.all.checked_sub(begin.all).filter(|all| *all > 0)?;
                let busy = end.busy.saturating_sub(begin.busy);
                let own = end.own.saturating_sub(begin.own);
                Some(busy.saturating_sub(own) as f64 / all as f64)
            });
        Machine {
            threads: thread::available_parallelism().map_or(1, Into::into),
            taken_by_others,
            card: self.card.as_ref().map(|before| card::after(self.facts, before)),
            clock_mhz: Spread::of(clocks_mhz.iter().copied()).map(|clock| [clock.min, clock.max]),
            peak_host_bytes: peak_host_bytes(),
        }
    }
}

impl Times {
    /// The ticks of `/proc/stat` and `/proc/self/stat`: both count in the same ticks (proc(5)).
    fn now() -> Option<Self> {
        let system = fs::read_to_string("/proc/stat").ok()?;
        let own = fs::read_to_string("/proc/self/stat").ok()?;
        Self::parse(&system, &own)
    }

    fn parse(system: &str, own: &str) -> Option<Self> {
        // user nice system idle iowait irq softirq steal; guests are in user and nice already.
        let ticks: Vec<u64> = system
            .lines()
            .next()?
            .strip_prefix("cpu ")?
            .split_whitespace()
            .take(8)
            .map(str::parse)
            .collect::<Result<_, _>>()
            .ok()?;
        let idle = ticks.get(3)? + ticks.get(4)?;
        let all: u64 = ticks.iter().sum();
        // The name in brackets may hold spaces; utime and stime are the 12th and 13th field after it.
        let fields: Vec<&str> = own.rsplit_once(')')?.1.split_whitespace().collect();
        let tick = |i: usize| fields.get(i)?.parse::<u64>().ok();
        Some(Self { all, busy: all - idle, own: tick(11)? + tick(12)? })
    }
}

/// The clock that decides how fast the device draws; `None` where the system does not tell.
pub fn clock_mhz(facts: &DeviceFacts) -> Option<f64> {
    match facts.kind {
        DeviceKind::Cpu => processor_mhz(&fs::read_to_string("/proc/cpuinfo").ok()?),
        _ if facts.ids[0] == nvidia::VENDOR => Some(nvidia::property("clocks.sm", facts.pci)?.0),
        _ => card_mhz(facts),
    }
}

/// The mean over the processor's threads.
fn processor_mhz(cpuinfo: &str) -> Option<f64> {
    let mhz: Vec<f64> = cpuinfo
        .lines()
        .filter_map(|line| line.strip_prefix("cpu MHz")?.split_once(':')?.1.trim().parse().ok())
        .collect();
    (!mhz.is_empty()).then(|| mhz.iter().sum::<f64>() / mhz.len() as f64)
}

/// The clock of the card with this device's PCI numbers: amdgpu's list of levels, or i915's file.
fn card_mhz(facts: &DeviceFacts) -> Option<f64> {
    let [vendor, device, _] = facts.ids;
    let number = |path: &Path| {
        u32::from_str_radix(fs::read_to_string(path).ok()?.trim().trim_start_matches("0x"), 16).ok()
    };
    fs::read_dir("/sys/class/drm").ok()?.flatten().map(|entry| entry.path()).find_map(|card| {
        let pci = card.join("device");
        (number(&pci.join("vendor"))? == vendor && number(&pci.join("device"))? == device).then_some(())?;
        let level = fs::read_to_string(pci.join("pp_dpm_sclk")).ok().and_then(|levels| amd_mhz(&levels));
        level.or_else(|| fs::read_to_string(card.join("gt_cur_freq_mhz")).ok()?.trim().parse().ok())
    })
}

/// The level with a star, such as `1: 1000Mhz *`.
fn amd_mhz(levels: &str) -> Option<f64> {
    let line = levels.lines().find(|line| line.trim_end().ends_with('*'))?;
    line.split_once(':')?.1.trim().split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}

/// `VmHWM` of `/proc/self/status`.
fn peak_host_bytes() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024 * line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read() {
        let system = "cpu  100 1 50 800 20 3 4 2 7 0\ncpu0 50 0 25 400 10 1 2 1 0 0\n";
        let own = "42 (a (b) c) R 1 42 42 0 -1 4194304 100 0 0 0 31 7 0 0 20 0 3 0 55 1000 200 1844";
        let times = Times::parse(system, own).unwrap();
        assert_eq!((times.all, times.busy, times.own), (980, 160, 38));
        for broken in ["", "cpu", "cpu  a b", "intr 1"] {
            assert!(Times::parse(broken, own).is_none(), "{broken}");
        }
        assert!(Times::parse(system, "42").is_none());
    }

    #[test]
    fn clocks_are_read() {
        assert_eq!(processor_mhz("cpu MHz\t\t: 2000.5\nx: 1\ncpu MHz : 2100.5\n"), Some(2050.5));
        assert_eq!(processor_mhz("model name: x"), None);
        assert_eq!(amd_mhz("0: 500Mhz\n1: 1825Mhz *\n2: 2000Mhz\n"), Some(1825.0));
        assert_eq!(amd_mhz("0: 500Mhz\n"), None);
    }
}
