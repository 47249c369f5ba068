//! All cores in one thread, in virtual time: the reference.
