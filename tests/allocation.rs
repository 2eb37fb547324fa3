//! After initialization a step and a reading allocate nothing, and free nothing: a host's real-time thread may do both.
#![allow(unsafe_code, reason = "a global allocator that counts")]

mod harness;

use harness::{Instance, reals, scene, there};
use split_rotor::abi::{Real, Status};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system's allocator; counts what the present thread asks of it, so that other tests do not disturb.
struct Counting;

thread_local! {
    /// Allocations (also each that changes its size), and releases.
    static COUNTS: Cell<[u64; 2]> = const { Cell::new([0, 0]) };
}

fn count(which: usize) {
    // A thread that ends may still allocate when its locals are gone.
    let _ = COUNTS.try_with(|counts| {
        let mut value = counts.get();
        value[which] += 1;
        counts.set(value);
    });
}

// SAFETY: all is passed on to the system's allocator; counting neither allocates nor unwinds.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(0);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(0);
        // SAFETY: the caller's promise.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(0);
        // SAFETY: the caller's promise.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(1);
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations and releases of the present thread during `body`.
fn counts_of(body: impl FnOnce()) -> [u64; 2] {
    let before = COUNTS.get();
    body();
    let after = COUNTS.get();
    [after[0] - before[0], after[1] - before[1]]
}

/// A second of the scene at 0.01 s a step, all Real variables read after each; damped, so that the work
/// integrals are solved too, if `damping` is positive and the scene has a support.
fn counts_of_a_second(mut instance: Instance, method: i32, damping: Real) -> [u64; 2] {
    instance.set_method(method);
    let mut instance = instance.started(&there(&[("support.d1", damping)]));
    let (references, step) = (reals(scene()), 0.01);
    let mut values = vec![Real::NAN; references.len()];
    let counts = counts_of(|| {
        for i in 0..100 {
            assert_eq!(instance.do_step(f64::from(i) * step, step), Status::Ok);
            assert_eq!(instance.read(&references, &mut values), Status::Ok);
        }
    });
    assert!(values.iter().all(|value| value.is_finite()));
    assert!(instance.get("solver.steps") > 10.0, "the solver did work");
    counts
}

#[test]
fn the_counters_count() {
    assert_eq!(counts_of(|| drop(std::hint::black_box(Box::new(1_u64)))), [1, 1]);
    assert_eq!(counts_of(|| drop(std::hint::black_box(vec![0_u8; 64]))), [1, 1], "zeroed memory counts");
    let mut text = String::with_capacity(1);
    let growth = counts_of(|| std::hint::black_box(&mut text).push_str("a text that is longer"));
    assert_eq!(growth, [1, 0], "growth counts");
    // What happens within the exported functions counts: an instance is on the heap, and so is a refusal's message.
    let [allocations, releases] = counts_of(|| drop(Instance::quiet()));
    assert!(allocations > 0 && releases > 0);
    let mut instance = Instance::quiet();
    let mut status = Status::Ok;
    let [allocations, _] = counts_of(|| status = instance.do_step(0.0, 0.1));
    assert_eq!(status, Status::Error);
    assert!(allocations > 0);
}

#[test]
fn a_step_and_a_reading_allocate_nothing() {
    for method in [1, 2, 3, 4, 5, 6] {
        for damping in [0.0, 20.0] {
            let counts = counts_of_a_second(Instance::quiet(), method, damping);
            assert_eq!(counts, [0, 0], "logging off, method {method}, support.d1 = {damping}");
            let counts = counts_of_a_second(Instance::talkative(), method, damping);
            assert_eq!(counts, [0, 0], "logging on, method {method}, support.d1 = {damping}");
        }
    }
}
