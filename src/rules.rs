//! Rules: what facts mean.
