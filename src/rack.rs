//! Racks: which balls stand where when a game begins.
