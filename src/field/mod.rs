//! Functions of n coordinates as expression graphs: built, simplified, differentiated, analysed. Knows neither language nor files.

pub mod graph;

pub use graph::{Coordinate, Coordinates, Graph, Node, NodeId, SharedLeaf};
