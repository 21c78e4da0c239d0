//! What a process may use, and has used. Only Linux enforces a limit on memory.

/// Whether [`limit_memory`] has an effect.
pub(super) const MEMORY_IS_LIMITED: bool = cfg!(target_os = "linux");

/// Limits the address space of this process, and of those it starts, to a number of MiB; allocations beyond it fail.
/// Crashes leave no core files.
#[cfg(target_os = "linux")]
pub(super) fn limit_memory(mib: u64) -> Result<(), String> {
    use nix::sys::resource::{Resource, setrlimit};
    let bytes = mib.saturating_mul(1 << 20);
    setrlimit(Resource::RLIMIT_AS, bytes, bytes).map_err(|error| error.to_string())?;
    setrlimit(Resource::RLIMIT_CORE, 0, 0).map_err(|error| error.to_string())
}

/// Nothing: there is no such limit here.
#[cfg(not(target_os = "linux"))]
pub(super) fn limit_memory(_mib: u64) -> Result<(), String> {
    Ok(())
}

/// Limits the processor time, so that a process that outlives its master comes to an end.
#[cfg(unix)]
pub(super) fn limit_processor(seconds: u64) -> Result<(), String> {
    use nix::sys::resource::{Resource, setrlimit};
    setrlimit(Resource::RLIMIT_CPU, seconds, seconds).map_err(|error| error.to_string())
}

/// Nothing: there is no such limit here.
#[cfg(not(unix))]
pub(super) fn limit_processor(_seconds: u64) -> Result<(), String> {
    Ok(())
}

/// The most memory that this process, or any that it waited for, has had at once, in MiB; `None` where nobody knows.
#[cfg(unix)]
pub(super) fn peak_mib(of_children: bool) -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    let who = if of_children {
        UsageWho::RUSAGE_CHILDREN
    } else {
        UsageWho::RUSAGE_SELF
    };
    // Kibibytes, except on Apple's systems.
    let unit = if cfg!(target_vendor = "apple") {
        1.0
    } else {
        1024.0
    };
    let size = getrusage(who).ok()?.max_rss() as f64 * unit;
    Some(size / f64::from(1 << 20))
}

/// The most memory that this process, or any that it waited for, has had at once, in MiB; `None` where nobody knows.
#[cfg(not(unix))]
pub(super) fn peak_mib(_of_children: bool) -> Option<f64> {
    None
}
