//! Functions of n coordinates as expression graphs: built, simplified, differentiated, analysed. Knows neither language nor files.

pub mod build;
pub mod derivative;
pub mod expand;
pub mod facts;
pub mod folded;
pub mod graph;
pub mod rays;
pub mod region;
pub mod slopes;
pub mod steepness;

pub use derivative::derivative;
pub use facts::operations;
pub use graph::{Coordinate, Coordinates, Graph, Node, NodeId, SharedLeaf};
pub use region::{Bound, Form, Guard, Region, SharedRegion};
