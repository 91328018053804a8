//! The one module with `unsafe`: shared access to body rows.
#![allow(unsafe_code)]

mod shared;

pub(crate) use shared::SharedRows;
