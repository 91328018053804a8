//! Saving a frame over an older one and going back to it allocate nothing.
#![allow(unsafe_code, reason = "an allocator that counts")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use tiny_physics_scenes::{Options, Run, find};

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn frames_of_the_same_size_need_no_memory() {
    for scene in ["ragdoll", "pyramid", "galton_board"] {
        let mut run = Run::start(&find(scene).unwrap().build(Options::default())).unwrap();
        (0..60).for_each(|_| run.step());
        let world = run.world_mut();
        let mut frame = world.clone();
        world.step(1.0 / 60.0);
        let before = ALLOCATIONS.get();
        world.clone_from(&frame);
        let back = ALLOCATIONS.get();
        frame.clone_from(world);
        let again = ALLOCATIONS.get();
        assert_eq!((back - before, again - back), (0, 0), "{scene}");
    }
}
