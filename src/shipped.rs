//! Configuration that is compiled in.
