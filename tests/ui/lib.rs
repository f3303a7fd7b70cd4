//! The cases are in `err` and `ok`, the test that compiles them in `tests`.

use aim as _;
