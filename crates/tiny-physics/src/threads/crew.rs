//! The crew: threads that work on the chunks of one stage after another.
//!
//! # Protocol
//!
//! One caller at a time owns the crew, through [`Section`]. To run a stage it writes the job, sets
//! `unfinished` to the number of chunks, fills the seats, raises `news` and wakes sleepers; then it works
//! like every member and waits until `unfinished` is zero.
//!
//! A member owns a chunk when its compare-and-swap takes the chunk's number off a seat. It reads the job
//! *after* that. The stage cannot end before the chunk is counted off, so the job that it reads is the
//! one that the chunk belongs to, however late the member is: a swap that succeeds on the seat of a
//! later stage, where the numbers happen to be the same, claims a chunk of that later stage.
//!
//! What one stage wrote is seen by the next: count-offs release, the caller's wait acquires, the seats
//! it fills release, and claims acquire.
//!
//! Waking a thread costs the waker more than many a stage, so the caller wakes one sleeper a stage, and
//! each worker that wakes up to work wakes two more. No wake-up is lost: a worker first enters itself among the sleepers, then looks at `news` once more,
//! while the caller first raises `news` and then looks at the sleepers, all sequentially consistent; at
//! least one of them sees the other.

use std::any::Any;
use std::cell::UnsafeCell;
use std::marker::PhantomData;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::{self, JoinHandle, Thread};
use std::time::{Duration, Instant};

#[cfg(tiny_physics_race)]
use super::race;

/// Most members, one bit each in `sleepers`.
const MEMBER_LIMIT: usize = 64;
/// Looks at what is awaited before the first yield: 3 to 10 microseconds, by the processor.
const SPIN_COUNT: u32 = 256;
/// Yields of a caller before it sleeps between looks, so that the lowest priority gets its turn too.
const YIELD_COUNT: u32 = 4096;
/// How long a worker stays awake without work while no section is open.
const PARK_AFTER: Duration = Duration::from_micros(50);
/// The same within a section, where serial parts of the step may take a while.
const PARK_AFTER_IN_SECTION: Duration = Duration::from_millis(1);

/// Threads beside the caller. They end when it is dropped.
pub(super) struct Crew {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

/// The exclusive use of a crew, for one step of one world. It stays on its thread, and chunks cannot
/// get at it, because it is not `Sync`; so there is one stage at a time.
pub(super) struct Section<'a> {
    crew: &'a Crew,
    not_sync: PhantomData<*const ()>,
}

/// What the members see.
struct Shared {
    job: UnsafeCell<Job>,
    seats: Box<[Seat]>,
    unfinished: Counter,
    /// Goes up when there is something to look at: a stage, or the end.
    news: Counter,
    /// Bit m is set while member m is parked or about to be.
    sleepers: AtomicU64,
    /// The worker of each seat, for its wakers; set before it first sleeps.
    threads: Box<[OnceLock<Thread>]>,
    /// A section is open.
    open: AtomicBool,
    /// Workers are to end.
    closing: AtomicBool,
    panics: AtomicUsize,
    /// The panic of the lowest chunk of the stage.
    first_panic: Mutex<Option<(usize, Box<dyn Any + Send>)>>,
    /// Looks before the first yield; none with more members than cores.
    spin_count: u32,
}

/// The work of a stage: a closure whose lifetime is that of the stage.
#[derive(Clone, Copy)]
struct Job {
    chunk: *const (dyn Fn(usize) + Sync + 'static),
    #[cfg(tiny_physics_race)]
    stage: u64,
}

/// Chunks that nobody has claimed: the first in the low half, the one after the last in the high half.
/// Alone in its cache lines (two, because processors fetch them in pairs).
#[repr(align(128))]
struct Seat(AtomicU64);

/// A counter alone in its cache lines.
#[repr(align(128))]
struct Counter(AtomicUsize);

// SAFETY: all fields but `job` can be shared. `job` is written by the owner of the section alone, while
// no chunk is unfinished, and read by members that hold an unfinished chunk (see the module's protocol);
// its closure is `Sync`.
unsafe impl Sync for Shared {}
// SAFETY: the pointer in `job` is only followed during a stage, while its closure is borrowed.
unsafe impl Send for Shared {}

impl Crew {
    /// A crew of `member_count` with the caller, or as many as the system grants; none if that leaves the
    /// caller alone.
    pub(super) fn hire(member_count: usize) -> Option<Self> {
        let member_count = member_count.min(MEMBER_LIMIT);
        if member_count < 2 {
            return None;
        }
        let shared = Arc::new(Shared::new(member_count));
        let mut threads = Vec::with_capacity(member_count - 1);
        for member in 1..member_count {
            let shared = Arc::clone(&shared);
            let builder = thread::Builder::new().name(format!("physics {member}"));
            match builder.spawn(move || shared.work(member)) {
                Ok(thread) => threads.push(thread),
                // The chunks on seats without a member are taken by the others.
                Err(_) => break,
            }
        }
        if threads.is_empty() { None } else { Some(Self { shared, threads }) }
    }

    /// Number of members with the caller.
    pub(super) fn member_count(&self) -> usize {
        self.threads.len() + 1
    }

    /// The exclusive use of the crew, unless someone has it.
    pub(super) fn open(&self) -> Option<Section<'_>> {
        if self.shared.open.swap(true, Ordering::Acquire) {
            return None;
        }
        Some(Section { crew: self, not_sync: PhantomData })
    }

    /// Lets everybody look: at a stage, or at the end.
    #[inline]
    fn tell(&self) {
        self.shared.news.0.fetch_add(1, Ordering::SeqCst);
        if self.shared.sleepers.load(Ordering::SeqCst) != 0 {
            self.shared.wake_one();
        }
    }
}

impl Drop for Crew {
    fn drop(&mut self) {
        self.shared.closing.store(true, Ordering::Release);
        self.tell();
        for thread in self.threads.drain(..) {
            thread.thread().unpark();
            // Workers catch the panics of chunks; if one died all the same there is nothing to add.
            let _ = thread.join();
        }
    }
}

impl Drop for Section<'_> {
    fn drop(&mut self) {
        self.crew.shared.open.store(false, Ordering::Release);
    }
}

impl Section<'_> {
    /// Runs `chunk` once for each number below `chunk_count`, on all members, and returns when all are done.
    ///
    /// # Panics
    ///
    /// With the panic of the lowest chunk that panicked, after all chunks ran.
    pub(super) fn run(&self, chunk_count: u32, chunk: &(dyn Fn(usize) + Sync)) {
        let shared = &*self.crew.shared;
        debug_assert_eq!(shared.unfinished.0.load(Ordering::Relaxed), 0, "a stage within a stage");
        // SAFETY: only the lifetime changes, and the closure is not called after this function returns:
        // members call it for chunks that they own, and the wait below lasts until all are counted off.
        // Between here and there nothing unwinds: `take_part` catches the panics of chunks.
        let chunk = unsafe {
            std::mem::transmute::<
                *const (dyn Fn(usize) + Sync + '_),
                *const (dyn Fn(usize) + Sync + 'static),
            >(chunk)
        };
        // SAFETY: nobody reads the job now: no chunk is unfinished, since the stage before waited for
        // its own, and this section alone starts stages.
        unsafe {
            *shared.job.get() = Job {
                chunk,
                #[cfg(tiny_physics_race)]
                stage: race::new_stage(),
            };
        }
        shared.unfinished.0.store(chunk_count as usize, Ordering::Relaxed);
        shared.fill_seats(u64::from(chunk_count));
        self.crew.tell();
        shared.take_part(0);
        shared.wait_for_the_others();
        if shared.panics.load(Ordering::Relaxed) != 0 {
            shared.pass_on_panic();
        }
    }
}

impl Shared {
    fn new(member_count: usize) -> Self {
        let core_count = thread::available_parallelism().map_or(1, usize::from);
        let idle: &'static (dyn Fn(usize) + Sync) = &|_| ();
        Self {
            job: UnsafeCell::new(Job {
                chunk: idle,
                #[cfg(tiny_physics_race)]
                stage: 0,
            }),
            seats: (0..member_count).map(|_| Seat(AtomicU64::new(0))).collect(),
            unfinished: Counter(AtomicUsize::new(0)),
            news: Counter(AtomicUsize::new(0)),
            sleepers: AtomicU64::new(0),
            threads: (0..member_count).map(|_| OnceLock::new()).collect(),
            open: AtomicBool::new(false),
            closing: AtomicBool::new(false),
            panics: AtomicUsize::new(0),
            first_panic: Mutex::new(None),
            spin_count: if member_count > core_count { 0 } else { SPIN_COUNT },
        }
    }

    /// Gives each member its share of a stage.
    #[inline]
    fn fill_seats(&self, chunk_count: u64) {
        let seat_count = self.seats.len() as u64;
        let mut first = 0;
        for (seat, place) in self.seats.iter().zip(1..) {
            let end = chunk_count * place / seat_count;
            seat.0.store(end << 32 | first, Ordering::Release);
            first = end;
        }
    }

    /// Works on chunks until none is left to claim. A function of its own, as is the wait: what `scripts/serial-share.sh`
    /// counts is what a step does outside of both.
    #[inline(never)]
    fn take_part(&self, member: usize) {
        let mut done = 0;
        while let Some(chunk) = self.seats[member].claim_first() {
            self.run_chunk(chunk);
            done += 1;
        }
        let (before, after) = self.seats.split_at(member);
        for seat in after[1..].iter().chain(before) {
            while let Some(chunk) = seat.claim_last() {
                self.run_chunk(chunk);
                done += 1;
            }
        }
        if done != 0 {
            self.unfinished.0.fetch_sub(done, Ordering::Release);
        }
    }

    /// Runs a chunk that this member has claimed and not counted off.
    #[inline]
    fn run_chunk(&self, chunk: usize) {
        // SAFETY: the chunk is claimed and not counted off, so its stage lasts, and the job is not
        // written before it ends; the claim acquired what the section wrote.
        let job = unsafe { *self.job.get() };
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            #[cfg(tiny_physics_race)]
            let _inside = race::InChunk::enter(job.stage, chunk);
            // SAFETY: the stage lasts, so its closure is still borrowed.
            unsafe { (*job.chunk)(chunk) }
        }));
        if let Err(panic) = outcome {
            self.keep_panic(chunk, panic);
        }
    }

    /// Waits until every claimed chunk of the stage is counted off.
    #[inline(never)]
    fn wait_for_the_others(&self) {
        let mut looks = 0;
        while self.unfinished.0.load(Ordering::Acquire) != 0 {
            if looks < self.spin_count {
                std::hint::spin_loop();
            } else if looks < self.spin_count + YIELD_COUNT {
                thread::yield_now();
            } else {
                thread::sleep(PARK_AFTER);
                continue;
            }
            looks += 1;
        }
    }

    #[cold]
    fn keep_panic(&self, chunk: usize, panic: Box<dyn Any + Send>) {
        self.panics.fetch_add(1, Ordering::Relaxed);
        let mut first = self.first_panic.lock().unwrap_or_else(PoisonError::into_inner);
        let lower = first.as_ref().is_none_or(|(other, _)| chunk < *other);
        let other = if lower { first.replace((chunk, panic)) } else { Some((chunk, panic)) };
        // Not dropped: what panics carry may panic when dropped, and here nothing may unwind.
        std::mem::forget(other);
    }

    #[cold]
    fn pass_on_panic(&self) {
        self.panics.store(0, Ordering::Relaxed);
        let first = self.first_panic.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some((_, panic)) = first {
            resume_unwind(panic);
        }
    }

    /// The life of a worker.
    fn work(&self, member: usize) {
        self.threads[member].get_or_init(thread::current);
        let mut seen = 0;
        loop {
            seen = self.wait_for_news(member, seen);
            if self.closing.load(Ordering::Acquire) {
                return;
            }
            self.take_part(member);
        }
    }

    /// Waits until `news` is no longer `seen`.
    fn wait_for_news(&self, member: usize, seen: usize) -> usize {
        for _ in 0..self.spin_count {
            let news = self.news.0.load(Ordering::Acquire);
            if news != seen {
                return news;
            }
            std::hint::spin_loop();
        }
        let start = Instant::now();
        loop {
            let news = self.news.0.load(Ordering::Acquire);
            if news != seen {
                return news;
            }
            let in_section = self.open.load(Ordering::Relaxed);
            let patience = if in_section { PARK_AFTER_IN_SECTION } else { PARK_AFTER };
            if start.elapsed() > patience {
                return self.park(member, seen);
            }
            thread::yield_now();
        }
    }

    /// Sleeps until `news` is no longer `seen`.
    #[cold]
    fn park(&self, member: usize, seen: usize) -> usize {
        let bit = 1 << member;
        loop {
            // Again after each wake-up: the waker clears the bit, and may be late, from an earlier stage.
            self.sleepers.fetch_or(bit, Ordering::SeqCst);
            let news = self.news.0.load(Ordering::SeqCst);
            if news != seen {
                self.sleepers.fetch_and(!bit, Ordering::AcqRel);
                self.wake_one();
                self.wake_one();
                return news;
            }
            thread::park();
        }
    }

    /// Wakes one sleeper, if there is one.
    #[cold]
    fn wake_one(&self) {
        let mut sleepers = self.sleepers.load(Ordering::SeqCst);
        while sleepers != 0 {
            let member = sleepers.trailing_zeros();
            let bit = 1 << member;
            sleepers = self.sleepers.fetch_and(!bit, Ordering::AcqRel);
            if sleepers & bit != 0 {
                if let Some(thread) = self.threads[member as usize].get() {
                    thread.unpark();
                }
                return;
            }
        }
    }
}

impl Seat {
    /// Claims the first chunk: for the seat's own member.
    #[inline]
    fn claim_first(&self) -> Option<usize> {
        self.claim(|first, end| (first, end << 32 | (first + 1)))
    }

    /// Claims the last chunk: for others.
    #[inline]
    fn claim_last(&self) -> Option<usize> {
        self.claim(|first, end| (end - 1, (end - 1) << 32 | first))
    }

    /// Claims the chunk that `choose` names, which also gives what stays on the seat.
    #[inline(always)]
    fn claim(&self, choose: impl Fn(u64, u64) -> (u64, u64)) -> Option<usize> {
        let mut seat = self.0.load(Ordering::Relaxed);
        loop {
            let (first, end) = (seat & 0xFFFF_FFFF, seat >> 32);
            if first >= end {
                return None;
            }
            let (chunk, rest) = choose(first, end);
            match self.0.compare_exchange_weak(seat, rest, Ordering::Acquire, Ordering::Relaxed) {
                Ok(_) => return Some(chunk as usize),
                Err(now) => seat = now,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dropping_the_crew_ends_its_threads() {
        for rest in [Duration::ZERO, PARK_AFTER * 40] {
            let crew = Crew::hire(4).expect("threads");
            let shared = Arc::downgrade(&crew.shared);
            crew.open().expect("free").run(9, &|_| ());
            thread::sleep(rest);
            drop(crew);
            assert_eq!(shared.strong_count(), 0);
        }
    }

    #[test]
    fn a_crew_has_one_owner_at_a_time() {
        let crew = Crew::hire(2).expect("threads");
        let section = crew.open();
        assert!(section.is_some());
        // Asking must not free it.
        assert!(crew.open().is_none() && crew.open().is_none());
        drop(section);
        assert!(crew.open().is_some());
    }

    #[test]
    fn workers_park_when_idle_and_wake_for_work() {
        let crew = Crew::hire(4).expect("threads");
        let wait = |done: &dyn Fn() -> bool| {
            let start = Instant::now();
            while !done() {
                assert!(start.elapsed() < Duration::from_secs(60), "waited in vain");
                thread::yield_now();
            }
        };
        for _ in 0..20 {
            wait(&|| crew.shared.sleepers.load(Ordering::SeqCst).count_ones() == 3);
            // All members must come, or the chunks wait for ever.
            let come = AtomicUsize::new(0);
            crew.open().expect("free").run(4, &|_| {
                come.fetch_add(1, Ordering::SeqCst);
                wait(&|| come.load(Ordering::SeqCst) == 4);
            });
        }
    }

    #[test]
    fn seats_are_emptied_from_both_ends() {
        let seat = Seat(AtomicU64::new(5 << 32 | 2));
        assert_eq!(seat.claim_first(), Some(2));
        assert_eq!(seat.claim_last(), Some(4));
        assert_eq!(seat.claim_last(), Some(3));
        assert_eq!((seat.claim_first(), seat.claim_last()), (None, None));
    }
}
