//! Runs a worker program on one job.

use peers_worker::{Answer, Job, Report};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Starts the program, gives it the job and waits for its report.
///
/// # Errors
/// The program does not start, crashes, says nothing that can be understood, or refuses the job.
pub fn run(program: &Path, job: &Job) -> Result<Report, String> {
    let mut worker = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| format!("{} does not start: {error}", program.display()))?;
    if let Some(mut input) = worker.stdin.take() {
        let line = serde_json::to_string(job).map_err(|error| error.to_string())? + "\n";
        // A worker that died early is reported below by its status.
        let _ = input.write_all(line.as_bytes());
    }
    let output = worker.wait_with_output().map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err(format!("the worker ended with {}", output.status));
    }
    match serde_json::from_slice(&output.stdout) {
        Ok(Answer::Done(report)) => Ok(report),
        Ok(Answer::Failed(reason)) => Err(reason),
        Err(error) => Err(format!("the worker's answer is no report: {error}")),
    }
}
