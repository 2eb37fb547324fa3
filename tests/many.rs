//! Many instances: none of ten thousand leaves anything in memory, and sixty-four at a time give the bits of one alone.
#![allow(unsafe_code, reason = "a global allocator that counts")]

mod harness;

use harness::{FAST, Instance, Saved, inputs};
use split_rotor::abi::{CO_SIMULATION, Choice, MODEL_EXCHANGE, Real, Status};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system's allocator; counts the bytes that the present thread has and did not give back.
struct Counting;

thread_local! {
    static LIVE: Cell<isize> = const { Cell::new(0) };
}

fn count(bytes: isize) {
    // A thread that ends may still allocate when its locals are gone.
    let _ = LIVE.try_with(|live| live.set(live.get() + bytes));
}

fn size(layout: Layout) -> isize {
    layout.size().cast_signed()
}

// SAFETY: all is passed on to the system's allocator; counting neither allocates nor unwinds.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(size(layout));
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-size(layout));
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const CYCLES: u32 = 10_000;

/// What one cycle after another leaves in memory [bytes]; the first ones may prepare what is there once.
fn left_by(mut cycle: impl FnMut(u32)) -> isize {
    (0..10).for_each(&mut cycle);
    let before = LIVE.get();
    (10..CYCLES).for_each(cycle);
    LIVE.get() - before
}

/// A short life of an instance: a run, a saved state in memory and as bytes, a refusal, a step that cannot be done.
fn live(instance: Instance, kind: Choice, n: u32) -> Instance {
    let mut instance = if n % 4 == 3 { instance.started(&FAST) } else { instance.started(&[]) };
    if kind == MODEL_EXCHANGE {
        instance.settled();
        instance.midpoint_step(0.0, 1e-3);
    } else {
        instance.do_step(0.0, 1e-3);
    }
    let saved = Saved::of(&instance);
    let read = Saved::read(&instance, &saved.bytes(&instance)).expect("the bytes are whole");
    read.restore(&instance);
    read.free(&instance);
    saved.free(&instance);
    assert_eq!(instance.enter_initialization(), Status::Error);
    instance.journal.take();
    instance
}

#[test]
fn the_counter_counts() {
    let before = LIVE.get();
    let kept = std::hint::black_box(vec![0_u8; 64]);
    assert_eq!(LIVE.get() - before, 64);
    drop(kept);
    assert_eq!(LIVE.get(), before);
    let instance = Instance::quiet();
    assert!(LIVE.get() > before, "an instance is on the heap");
    drop(instance);
    assert_eq!(LIVE.get(), before);
}

#[test]
fn fmi_ten_thousand_instances_leave_nothing_in_memory() {
    for kind in [CO_SIMULATION, MODEL_EXCHANGE] {
        assert_eq!(left_by(|n| drop(live(Instance::of(kind), kind, n))), 0, "kind {kind}");
    }
}

#[test]
fn fmi_ten_thousand_resets_leave_nothing_in_memory() {
    for kind in [CO_SIMULATION, MODEL_EXCHANGE] {
        let mut instance = Some(Instance::of(kind));
        let left = left_by(|n| {
            let mut lived = live(instance.take().expect("it is put back"), kind, n);
            assert_eq!(lived.reset(), Status::Ok);
            instance = Some(lived);
        });
        assert_eq!(left, 0, "kind {kind}");
    }
}

/// So many instances at a time, on so many threads.
const INSTANCES: u32 = 64;
const THREADS: u32 = 8;

/// Steps that each of them makes.
const STEPS: u32 = 20;

fn kind_of(n: u32) -> Choice {
    if n.is_multiple_of(4) { MODEL_EXCHANGE } else { CO_SIMULATION }
}

/// Instance `n`, each with a start and an input of its own.
fn instance(n: u32) -> Instance {
    let speed = [("start.omega.x", 30.0 + Real::from(n)), ("start.gamma.z", 0.01 * Real::from(n))];
    let mut instance = Instance::of(kind_of(n));
    for input in inputs() {
        assert_eq!(instance.write(&[input], &[0.1 * Real::from(n)]), Status::Ok);
    }
    let mut instance = instance.started(&speed);
    if kind_of(n) == MODEL_EXCHANGE {
        instance.settled();
    }
    instance
}

/// The bits after step `i` of instance `n`.
fn step(instance: &mut Instance, n: u32, i: u32) -> Vec<u64> {
    let now = Real::from(i);
    let bits = if kind_of(n) == MODEL_EXCHANGE {
        instance.integrate(now * 1e-3, 1e-3, 1)
    } else {
        instance.run(now * 0.01, 0.01, 1)
    };
    bits.concat()
}

#[test]
fn fmi_sixty_four_instances_on_eight_threads_give_the_same_bits_as_alone() {
    let alone: Vec<Vec<Vec<u64>>> = (0..INSTANCES)
        .map(|n| {
            let mut instance = instance(n);
            (0..STEPS).map(|i| step(&mut instance, n, i)).collect()
        })
        .collect();
    let check = |thread: u32| {
        // Its instances take turns.
        let mut own: Vec<_> = (thread..INSTANCES).step_by(THREADS as usize).map(|n| (n, instance(n))).collect();
        for i in 0..STEPS {
            for (n, instance) in &mut own {
                assert!(step(instance, *n, i) == alone[*n as usize][i as usize], "instance {n} goes another way");
            }
        }
    };
    std::thread::scope(|scope| {
        for thread in 0..THREADS {
            let check = &check;
            scope.spawn(move || check(thread));
        }
    });
}
