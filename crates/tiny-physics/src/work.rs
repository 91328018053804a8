//! Counted work, for tests of how costs grow: steps along lists, whatever the machine.

#[cfg(test)]
thread_local! {
    static DONE: core::cell::Cell<u64> = const { core::cell::Cell::new(0) };
}

/// One more step along a list. Nothing outside of this crate's own tests.
#[inline(always)]
pub(crate) fn note() {
    #[cfg(test)]
    DONE.with(|done| done.set(done.get() + 1));
}

/// Steps that `work` takes on this thread.
#[cfg(test)]
pub(crate) fn counted(work: impl FnOnce()) -> u64 {
    let before = DONE.with(core::cell::Cell::get);
    work();
    DONE.with(core::cell::Cell::get) - before
}
