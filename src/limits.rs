//! Every limit of the program in one struct, so that nothing a user types can exhaust the machine.
//!
//! Each limit is tested at n and at n + 1 (`tests/it/limits.rs`).

/// The bounds within which a session works. All are generous; each error that one of them causes names the number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one source text. The tree of a text of short terms takes more than a hundred times as many.
    pub source_bytes: usize,
    /// Depth of brackets, blocks and prefix operators in a text.
    pub nesting: usize,
    /// Errors told for one input; the rest is counted.
    pub errors: usize,
    /// Depth of calls of user functions (recursion).
    pub call_depth: usize,
    /// Turns that all loops together may take while one input or question is answered.
    pub loop_turns: usize,
    /// Elements of one array, nested ones counted.
    pub array_elements: usize,
    /// Nodes of the expression graph of a session.
    pub graph_nodes: usize,
    /// Turns of a loop that runs at each point; a point that takes more is undefined.
    pub point_turns: usize,
    /// Pieces into which the search for the highest value over a section may look, at each point.
    pub section_pieces: usize,
    /// Operations of one compiled program, after maps are expanded.
    pub program_operations: usize,
    /// Bytes that one task (mesh, picture, volume) may take by estimate.
    pub memory_bytes: usize,
    /// Bytes of one data file (volume, mesh).
    pub data_bytes: usize,
    /// Operations at points (one for a box counts as eight) that the search for a modelling space may spend before it takes what it knows
    /// by then.
    pub search_operations: usize,
    /// Boxes that a question about objects (INTERSECTS, DISTANCE ...) may look at before it says that it cannot decide.
    pub question_boxes: usize,
    /// Nodes that the analysis of an object along rays looks at, for one centre.
    pub ray_nodes: usize,
    /// Operations of an object that is written as functions of POV-Ray; a longer one is a mesh alone there.
    pub pov_operations: usize,
    /// Frames of one animation or numbered series.
    pub frames: usize,
    /// Pixels along one side of a picture.
    pub picture_side: usize,
    /// Bytes of earlier results that a session keeps, so that what an input did not change is not computed again.
    pub reuse_bytes: usize,
    /// Inputs that can be undone.
    pub undo_levels: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            source_bytes: 32 << 20,
            nesting: 1_000,
            errors: 50,
            call_depth: 1_000,
            loop_turns: 10_000_000,
            array_elements: 10_000_000,
            graph_nodes: 20_000_000,
            point_turns: 10_000,
            section_pieces: 600,
            program_operations: 8_000_000,
            memory_bytes: 4 << 30,
            data_bytes: 2 << 30,
            search_operations: 300_000_000,
            question_boxes: 200_000,
            ray_nodes: 2_000_000,
            pov_operations: 20_000,
            frames: 10_000,
            picture_side: 16_384,
            reuse_bytes: 256 << 20,
            undo_levels: 1_000,
        }
    }
}
