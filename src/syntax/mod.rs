//! Text → ast: what was written, includes read, every syntax error noted.

pub mod ast;
