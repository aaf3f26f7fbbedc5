//! Temperature of the contact above its surroundings: by friction ([`sliding`], from a line source at rest and from one that moves),
//! and by the current ([`joule`]).

pub mod joule;
mod moving_source;
pub mod sliding;
pub mod spot;
