//! Volumes, areas and moments against closed forms; how errors and costs change with the resolution.
