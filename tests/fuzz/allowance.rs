//! An allocator that refuses what no small file may cost.
//!
//! A refused allocation ends the process, which names its size: to libFuzzer that is a crash with
//! its input, to a test a failure.

use std::alloc::{GlobalAlloc, Layout, System};

/// The largest allocation [bytes].
const LARGEST: usize = 256 << 20;

struct Allowance;

#[global_allocator]
static ALLOWANCE: Allowance = Allowance;

#[allow(unsafe_code)]
// SAFETY: every call that is not refused goes to the system's allocator as it came.
unsafe impl GlobalAlloc for Allowance {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if layout.size() > LARGEST {
            return std::ptr::null_mut();
        }
        // SAFETY: the caller keeps the rules of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if layout.size() > LARGEST {
            return std::ptr::null_mut();
        }
        // SAFETY: the caller keeps the rules of `alloc_zeroed`.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the rules of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if size > LARGEST {
            return std::ptr::null_mut();
        }
        // SAFETY: the caller keeps the rules of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}
