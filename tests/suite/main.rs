//! One integration binary: tests by behaviour.

mod reference;
