//! Work of others on a graphics card: how busy it is while we leave it idle. Where neither amdgpu's files nor
//! `nvidia-smi` tell, that is unknown, and said so.

use std::{fs, path::Path, thread, time::Duration};

use surfel::{
    report::bench::{CardUse, TrustLimits},
    vk::{DeviceFacts, DeviceKind},
};

use super::{nvidia, pci};

/// The folder in which Linux lists graphics cards.
const DRM: &str = "/sys/class/drm";

/// Drivers tell the mean over up to a second: till then our own work, or the opening of the device, may be in it.
const READINGS: usize = 8;
const PAUSE: Duration = Duration::from_millis(250);

/// The use before our first frame; `None` where the processor draws.
pub fn before(facts: &DeviceFacts) -> Option<CardUse> {
    (facts.kind != DeviceKind::Cpu).then(|| CardUse {
        busy_before: quietest(|| busy(facts)),
        busy_after: None,
        other_processes: (facts.ids[0] == nvidia::VENDOR)
            .then(|| nvidia::other_processes(nvidia::property(BUSY, facts.pci)?.1))
            .flatten(),
    })
}

/// `before`, with the use after our last frame.
pub fn after(facts: &DeviceFacts, before: &CardUse) -> CardUse {
    // Where nothing was known before, nothing is now: a tool that hangs need not be waited for again.
    let busy_after = before.busy_before.and_then(|_| quietest(|| busy(facts)));
    CardUse { busy_after, ..before.clone() }
}

/// `nvidia-smi`'s name of it.
const BUSY: &str = "utilization.gpu";

/// The part of the time that the card is busy.
fn busy(facts: &DeviceFacts) -> Option<f64> {
    let percent = match facts.ids[0] {
        nvidia::VENDOR => nvidia::property(BUSY, facts.pci)?.0,
        _ => amd_percent(Path::new(DRM), facts.pci)?,
    };
    Some(0.01 * percent)
}

/// amdgpu's file.
fn amd_percent(drm: &Path, address: Option<pci::Address>) -> Option<f64> {
    let (_, device) = pci::the_one(pci::cards(drm), address)?;
    fs::read_to_string(device.join("gpu_busy_percent")).ok()?.trim().parse().ok()
}

/// The least of several readings; the first that is small enough ends them.
fn quietest(mut read: impl FnMut() -> Option<f64>) -> Option<f64> {
    let enough = TrustLimits::default().busy;
    let mut least = read()?;
    for _ in 1..READINGS {
        if least <= enough {
            break;
        }
        thread::sleep(PAUSE);
        least = least.min(read()?);
    }
    Some(least)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder such as `/sys/class/drm`.
    fn drm(cards: &[(&str, &str, &str)]) -> temp_dir::TempDir {
        let drm = temp_dir::TempDir::new().unwrap();
        for (name, slot, busy) in cards {
            let device = drm.path().join(name).join("device");
            fs::create_dir_all(&device).unwrap();
            fs::write(device.join("uevent"), format!("DRIVER=amdgpu\nPCI_SLOT_NAME={slot}\n")).unwrap();
            fs::write(device.join("gpu_busy_percent"), busy).unwrap();
        }
        drm
    }

    #[test]
    fn a_card_is_found_among_the_files() {
        let two = drm(&[
            ("card0", "0000:03:00.0", "7\n"),
            ("card1", "0000:65:00.0", "42\n"),
            ("card1-DP-1", "0000:65:00.0", "1\n"),
            ("renderD128", "0000:65:00.0", "1\n"),
        ]);
        assert_eq!(amd_percent(two.path(), Some([0, 0x65, 0, 0])), Some(42.0));
        assert_eq!(amd_percent(two.path(), Some([0, 0x66, 0, 0])), None);
        assert_eq!(amd_percent(two.path(), None), None);
        let one = drm(&[("card0", "0000:03:00.0", "7\n"), ("card0-DP-1", "0000:03:00.0", "1\n")]);
        assert_eq!(amd_percent(one.path(), None), Some(7.0));
        // Other drivers have no such file, other systems no such folder.
        fs::remove_file(one.path().join("card0/device/gpu_busy_percent")).unwrap();
        assert_eq!(amd_percent(one.path(), None), None);
        assert_eq!(amd_percent(&one.path().join("none"), None), None);
    }

    #[test]
    fn our_own_work_is_waited_for_but_not_others() {
        let of = |readings: &[Option<f64>]| {
            let mut readings = readings.iter().copied().chain(std::iter::repeat(Some(0.9)));
            quietest(|| readings.next().flatten())
        };
        assert_eq!(of(&[Some(0.0), Some(1.0)]), Some(0.0));
        assert_eq!(of(&[Some(1.0), Some(0.3), Some(0.02), Some(0.01)]), Some(0.02));
        assert_eq!(of(&[None]), None);
        assert_eq!(of(&[]), Some(0.9));
    }
}
