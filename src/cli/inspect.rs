//! mock
use super::{Console, Signals, Status, arguments as a};
use crate::model::Session;
pub fn info(_: &Console, _: &Signals, _: &a::Info) -> Result<Status, Status> {
    Ok(Status::Done)
}
pub fn measure(_: &Console, _: &Signals, _: &a::Measure) -> Result<Status, Status> {
    Ok(Status::Done)
}
pub fn measure_one(_: &Console, _: &Signals, _: &mut Session, _: &a::Making, _: bool) -> Result<Status, Status> {
    Ok(Status::Done)
}
