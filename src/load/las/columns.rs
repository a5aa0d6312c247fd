//! What is read of records: places, colors and intensities of those points that count.

use glam::DVec3;
use las::PointDataBuilder;

use super::header::{Header, one_line};

/// One entry a point that counts.
#[derive(Default)]
pub(in crate::load) struct Columns {
    pub positions: Vec<DVec3>,
    /// Empty where the format has none.
    pub colors: Vec<[u16; 3]>,
    pub intensities: Vec<u16>,
    /// How many points were left out as noise.
    pub noise: u64,
    /// How many points were left out because they are marked so.
    pub withheld: u64,
}

/// Classes of points that are no surface: low and high noise.
pub(in crate::load) const NOISE: [u8; 2] = [7, 18];

impl Columns {
    /// The points of whole records.
    pub fn read(header: &Header, records: &[u8]) -> Result<Self, String> {
        let data = PointDataBuilder::new()
            .with_format(header.format)
            .with_transforms(header.transforms)
            .build_from_bytes(records.to_vec())
            .map_err(one_line)?;
        let mut columns = Self::default();
        // Which points count: flags are the upper bits of the class in formats 0 to 5, and stand before it in others.
        let (flags_at, withheld) = if header.format.is_extended { (15, 0b100) } else { (15, 0x80) };
        let mut counts = Vec::with_capacity(data.len());
        for (record, class) in records.chunks_exact(header.record_bytes).zip(data.classification()) {
            let is_withheld = record.get(flags_at).is_some_and(|flags| flags & withheld != 0);
            let is_noise = NOISE.contains(&class);
            columns.withheld += u64::from(is_withheld);
            columns.noise += u64::from(is_noise && !is_withheld);
            counts.push(!is_withheld && !is_noise);
        }
        let kept = || counts.iter().copied();
        let places = data.x().zip(data.y()).zip(data.z()).zip(kept()).filter(|(_, counts)| *counts);
        columns.positions = places.map(|(((x, y), z), _)| DVec3::new(x, y, z)).collect();
        let intensities = data.intensity().zip(kept()).filter(|(_, counts)| *counts);
        columns.intensities = intensities.map(|(intensity, _)| intensity).collect();
        if let Some(colors) = data.rgb() {
            let colors = colors.zip(kept()).filter(|(_, counts)| *counts);
            columns.colors = colors.map(|((r, g, b), _)| [r, g, b]).collect();
        }
        Ok(columns)
    }

    pub fn append(&mut self, mut next: Self) {
        self.positions.append(&mut next.positions);
        self.colors.append(&mut next.colors);
        self.intensities.append(&mut next.intensities);
        self.noise += next.noise;
        self.withheld += next.withheld;
    }
}
