//! Cards by where they sit on the PCI bus.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// Domain, bus, device, function.
pub type Address = [u32; 4];

/// The address that `0000:65:00.0` stands for, in hexadecimal.
pub fn address(text: &str) -> Option<Address> {
    let (rest, function) = text.trim().rsplit_once('.')?;
    let mut parts = rest.split(':').chain([function]).map(|part| u32::from_str_radix(part, 16));
    let mut next = || parts.next()?.ok();
    let address = [next()?, next()?, next()?, next()?];
    parts.next().is_none().then_some(address)
}

/// The one at `wanted`; the only one where that is not known. Of several it is not guessed.
pub fn the_one<T>(
    mut all: impl Iterator<Item = (Address, T)>,
    wanted: Option<Address>,
) -> Option<(Address, T)> {
    match wanted {
        Some(wanted) => all.find(|(address, _)| *address == wanted),
        None => all.next().filter(|_| all.next().is_none()),
    }
}

/// The cards in Linux's folder `/sys/class/drm`, each with its device's folder. Connectors and render nodes are none.
pub fn cards(drm: &Path) -> impl Iterator<Item = (Address, PathBuf)> {
    let is_card = |name: &str| {
        name.strip_prefix("card").is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
    };
    fs::read_dir(drm).into_iter().flatten().flatten().filter_map(move |entry| {
        is_card(entry.file_name().to_str()?).then_some(())?;
        let device = entry.path().join("device");
        let event = fs::read_to_string(device.join("uevent")).ok()?;
        let slot = event.lines().find_map(|line| line.strip_prefix("PCI_SLOT_NAME="))?;
        Some((address(slot)?, device))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read() {
        assert_eq!(address("0000:65:00.0"), Some([0, 0x65, 0, 0]));
        assert_eq!(address(" 00000001:B3:1F.7\n"), Some([1, 0xb3, 0x1f, 7]));
        for broken in ["", "65:00.0", "0000:65:00", "0:0000:65:00.0", "0000:xx:00.0", "[N/A]"] {
            assert_eq!(address(broken), None, "{broken}");
        }
    }

    #[test]
    fn one_is_found_by_its_address_or_by_being_alone() {
        let two = || [([0, 1, 0, 0], 'a'), ([0, 2, 0, 0], 'b')].into_iter();
        assert_eq!(the_one(two(), Some([0, 2, 0, 0])), Some(([0, 2, 0, 0], 'b')));
        assert_eq!(the_one(two(), Some([0, 3, 0, 0])), None);
        assert_eq!(the_one(two(), None), None);
        assert_eq!(the_one(two().take(1), None), Some(([0, 1, 0, 0], 'a')));
        // The only one there is, but not the one that draws.
        assert_eq!(the_one(two().take(1), Some([0, 2, 0, 0])), None);
    }
}
