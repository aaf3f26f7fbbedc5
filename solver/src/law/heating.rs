//! Temperature of the contact above its surroundings: by friction ([`sliding`], from a line source at rest and from one that moves),
//! and by the current ([`joule`]).

pub(crate) mod joule;
mod moving_source;
pub(crate) mod sliding;
pub(crate) mod spot;
