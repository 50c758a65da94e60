//! hyperstat in a browser: the requests and answers of `hyperstat_study::session`, through the memory of a
//! WebAssembly module that imports nothing.
//!
//! `request(length)` makes room for the UTF-8 of a request and says where; `ask()` answers it; `answer(part)` and
//! `answer_length(part)` say where the answer is: part 0 is the UTF-8 of its object, part 1 its numbers, 64-bit
//! floats in the machine's order. Both stay until the next request.

use std::cell::RefCell;

use hyperstat_study::session::{Answer, Session};

/// What the module holds.
#[derive(Default)]
struct Core {
    session: Session,
    request: Vec<u8>,
    answer: Answer,
}

thread_local! {
    static CORE: RefCell<Core> = RefCell::default();
}

/// Room for a request of so many bytes; returns its address.
#[expect(
    unsafe_code,
    reason = "a name that is exported, which another crate could export too"
)]
#[unsafe(no_mangle)]
pub extern "C" fn request(length: usize) -> usize {
    CORE.with_borrow_mut(|core| {
        core.request.clear();
        core.request.resize(length, 0);
        core.request.as_mut_ptr().expose_provenance()
    })
}

/// Answers the request.
#[expect(unsafe_code, reason = "as of `request`")]
#[unsafe(no_mangle)]
pub extern "C" fn ask() {
    CORE.with_borrow_mut(|core| {
        // It was written from outside.
        let request = std::hint::black_box(&core.request);
        core.answer = core.session.ask(&String::from_utf8_lossy(request));
    });
}

/// Address of a part of the answer: 0 its object, 1 its numbers.
#[expect(unsafe_code, reason = "as of `request`")]
#[unsafe(no_mangle)]
pub extern "C" fn answer(part: usize) -> usize {
    CORE.with_borrow(|core| match part {
        0 => core.answer.json.as_ptr().expose_provenance(),
        _ => core.answer.numbers.as_ptr().expose_provenance(),
    })
}

/// Number of bytes of its object, 0, or of its numbers, 1.
#[expect(unsafe_code, reason = "as of `request`")]
#[unsafe(no_mangle)]
pub extern "C" fn answer_length(part: usize) -> usize {
    CORE.with_borrow(|core| match part {
        0 => core.answer.json.len(),
        _ => core.answer.numbers.len(),
    })
}
