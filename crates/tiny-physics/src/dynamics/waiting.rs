//! Pairs of shapes that are close, but not so close that they need a contact.

use crate::codec::store;

store! {
    /// Pairs whose fat boxes overlap while they themselves are apart. What moves fast has many of them for each
    /// contact: so they are eight bytes each, in no table and in no list of a body.
    ///
    /// A pair may be here twice, or have a contact too: that is found out when its shapes come near.
    #[derive(Debug, PartialEq, Default)]
    pub(crate) struct Waiting {
        pub(crate) pairs: Vec<(u32, u32)>,
        /// Since the pairs were last looked at, a body fell asleep or a shape left the broad phase.
        pub(crate) stale: bool,
    }
}
