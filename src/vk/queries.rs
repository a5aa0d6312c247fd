//! Queries: timestamps and pipeline statistics, with the device's own limits honored.

use std::ops::Deref;

use ash::vk;

use super::{device::Device, garbage::Retired, owned::Owned, result::VkResultExt};
use crate::error::{Error, Result};

/// A pool of timestamps.
pub struct Timestamps {
    pool: QueryPool,
    period_ns: f64,
    valid_bits: u32,
}

impl Timestamps {
    /// A pool of `count` timestamps; `None` where the queue has none.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str, count: u32) -> Result<Option<Self>> {
        let limits = &device.facts().limits;
        if limits.timestamp_valid_bits == 0 {
            return Ok(None);
        }
        let info = vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(count);
        Ok(Some(Self {
            pool: QueryPool::new(device, name, info)?,
            period_ns: f64::from(limits.timestamp_period_ns),
            valid_bits: limits.timestamp_valid_bits,
        }))
    }

    /// Records a timestamp that is taken once all earlier commands are complete.
    ///
    /// # Safety
    /// `commands` must be recording; `index` is below [`QueryPool::count`] and was reset since its last write.
    pub unsafe fn write(&self, commands: vk::CommandBuffer, index: u32) {
        // Means the same as ALL_COMMANDS here, which best-practices validation warns about.
        let stage = vk::PipelineStageFlags2::BOTTOM_OF_PIPE;
        let Owned { device, raw, .. } = &self.pool.owned;
        // SAFETY: this function's contract.
        unsafe { device.raw().cmd_write_timestamp2(commands, stage, *raw, index) };
    }

    /// A timestamp in ticks; `None` where it was not written.
    ///
    /// # Errors
    /// Whatever the driver answers.
    ///
    /// # Safety
    /// `index` is below [`QueryPool::count`]; commands that reset it have run.
    pub unsafe fn read(&self, index: u32) -> Result<Option<u64>> {
        // SAFETY: this function's contract.
        let value = unsafe { self.pool.read(index, 1) }?;
        let mask = if self.valid_bits >= 64 { u64::MAX } else { (1 << self.valid_bits) - 1 };
        Ok(value.map(|v| v[0] & mask))
    }

    /// Seconds from one timestamp to a later one, across one wrap of the counter.
    pub fn seconds_between(&self, begin: u64, end: u64) -> f64 {
        seconds_between(begin, end, self.valid_bits, self.period_ns)
    }
}

fn seconds_between(begin: u64, end: u64, valid_bits: u32, period_ns: f64) -> f64 {
    let mask = if valid_bits >= 64 { u64::MAX } else { (1 << valid_bits) - 1 };
    (end.wrapping_sub(begin) & mask) as f64 * period_ns * 1e-9
}

/// A pool of counts of invocations: of the vertex, the fragment and the compute stage.
pub struct Statistics {
    pool: QueryPool,
}

impl Statistics {
    /// A pool of `count` queries; `None` where the device can't count.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str, count: u32) -> Result<Option<Self>> {
        if !device.facts().pipeline_statistics {
            return Ok(None);
        }
        let info = vk::QueryPoolCreateInfo::default()
            .query_type(vk::QueryType::PIPELINE_STATISTICS)
            .query_count(count)
            .pipeline_statistics(
                vk::QueryPipelineStatisticFlags::VERTEX_SHADER_INVOCATIONS
                    | vk::QueryPipelineStatisticFlags::FRAGMENT_SHADER_INVOCATIONS
                    | vk::QueryPipelineStatisticFlags::COMPUTE_SHADER_INVOCATIONS,
            );
        Ok(Some(Self { pool: QueryPool::new(device, name, info)? }))
    }

    /// Vertex, fragment and compute invocations of a query; `None` where it was not written.
    ///
    /// # Errors
    /// Whatever the driver answers.
    ///
    /// # Safety
    /// `index` is below [`QueryPool::count`]; commands that reset it have run.
    pub unsafe fn read(&self, index: u32) -> Result<Option<[u64; 3]>> {
        // SAFETY: this function's contract.
        unsafe { self.pool.read(index, 3) }
    }
}

/// A pool of queries whether anything was drawn. Their results stay on the device.
pub struct Occlusion {
    pool: QueryPool,
}

impl Occlusion {
    /// A pool of `count` queries.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str, count: u32) -> Result<Self> {
        let info = vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::OCCLUSION).query_count(count);
        Ok(Self { pool: QueryPool::new(device, name, info)? })
    }

    /// Records the copy of a result: 32 bits, 0 where nothing was drawn. The device waits for it, not the host.
    ///
    /// # Safety
    /// `commands` must be recording outside of rendering, after the query's end; `target` has 4 bytes and the usage
    /// `TRANSFER_DST`.
    pub unsafe fn copy(&self, commands: vk::CommandBuffer, index: u32, target: vk::Buffer) {
        let flags = vk::QueryResultFlags::WAIT;
        let Owned { device, raw, .. } = &self.pool.owned;
        // SAFETY: this function's contract.
        unsafe { device.raw().cmd_copy_query_pool_results(commands, *raw, index, 1, target, 0, 4, flags) };
    }
}

impl Deref for Timestamps {
    type Target = QueryPool;

    fn deref(&self) -> &QueryPool {
        &self.pool
    }
}

impl Deref for Statistics {
    type Target = QueryPool;

    fn deref(&self) -> &QueryPool {
        &self.pool
    }
}

impl Deref for Occlusion {
    type Target = QueryPool;

    fn deref(&self) -> &QueryPool {
        &self.pool
    }
}

/// The most queries of a pool: more than any frame has; of many more drivers promise memory that they don't have.
const MOST_QUERIES: u32 = 1 << 20;

/// The queries of a pool, whatever they ask.
pub struct QueryPool {
    owned: Owned<vk::QueryPool>,
    count: u32,
    name: String,
}

impl QueryPool {
    fn new(device: &Device, name: &str, info: vk::QueryPoolCreateInfo<'_>) -> Result<Self> {
        if info.query_count == 0 {
            return Err(Error::option(name, "a pool of no queries"));
        }
        if info.query_count > MOST_QUERIES {
            let problem = format!("a pool of {} queries: expected at most {MOST_QUERIES}", info.query_count);
            return Err(Error::option(name, problem));
        }
        // SAFETY: the device is alive and has the feature, see the callers; there are some.
        let raw =
            unsafe { device.raw().create_query_pool(&info, None) }.of_call("vkCreateQueryPool", name)?;
        let owned = device.own(raw, name, Retired::QueryPool);
        Ok(Self { owned, count: info.query_count, name: name.to_owned() })
    }

    /// The number of queries.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Records the reset of the first so many; comes before any write of them, outside of rendering.
    ///
    /// # Safety
    /// `commands` must be recording, outside of rendering; no unfinished submission uses the pool.
    pub unsafe fn reset(&self, commands: vk::CommandBuffer, count: u32) {
        let Owned { device, raw, .. } = &self.owned;
        // SAFETY: this function's contract.
        unsafe { device.raw().cmd_reset_query_pool(commands, *raw, 0, count.min(self.count)) };
    }

    /// Records the begin of a query.
    ///
    /// # Safety
    /// `commands` must be recording; the query is none of timestamps, was reset and is not active; begin and end come on the same
    /// side of a rendering's begin and end.
    pub unsafe fn begin(&self, commands: vk::CommandBuffer, index: u32) {
        let Owned { device, raw, .. } = &self.owned;
        // SAFETY: this function's contract.
        unsafe { device.raw().cmd_begin_query(commands, *raw, index, vk::QueryControlFlags::empty()) };
    }

    /// Records the end of a query.
    ///
    /// # Safety
    /// As [`QueryPool::begin`]; the query is active.
    pub unsafe fn end(&self, commands: vk::CommandBuffer, index: u32) {
        let Owned { device, raw, .. } = &self.owned;
        // SAFETY: this function's contract.
        unsafe { device.raw().cmd_end_query(commands, *raw, index) };
    }

    /// A query of `words` values, 3 at most, without a wait: what is not available is `None`. It lies in place, so that a host which looks at each frame takes nothing from the heap.
    ///
    /// # Safety
    /// `index` is below [`Self::count`]; commands that reset it have run.
    unsafe fn read(&self, index: u32, words: usize) -> Result<Option<[u64; 3]>> {
        let mut data = [0_u64; 4];
        let row = &mut data[..words + 1];
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WITH_AVAILABILITY;
        let bytes = size_of_val(row);
        let Owned { device, raw, .. } = &self.owned;
        let get = device.raw().fp_v1_0().get_query_pool_results;
        // SAFETY: `row` has room for the query's values and whether they are available; the pool is alive. The raw function
        // is called because ash's wrapper takes one element a query.
        let result = unsafe {
            let into = row.as_mut_ptr().cast();
            get(device.raw().handle(), *raw, index, 1, bytes, into, bytes as u64, flags)
        };
        match result {
            vk::Result::SUCCESS | vk::Result::NOT_READY => {}
            other => return Err(other).of_call("vkGetQueryPoolResults", &self.name),
        }
        let [first, second, third, _] = data;
        let values = [first, if words > 1 { second } else { 0 }, if words > 2 { third } else { 0 }];
        Ok((data[words] != 0).then_some(values))
    }
}

#[cfg(test)]
mod tests {
    use super::seconds_between;

    #[test]
    fn period_and_wrap_are_honored() {
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
        assert!(near(seconds_between(10, 35, 64, 40.0), 1e-6));
        assert!(near(seconds_between((1 << 36) - 5, 5, 36, 1.0), 1e-8));
        assert!(near(seconds_between(u64::MAX, 0, 64, 1e9), 1.0));
    }
}
