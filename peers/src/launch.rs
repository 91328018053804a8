//! Runs a worker program on one task.

use peers_worker::{Answer, Job, Report, Task};
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::time::Duration;

/// Longer than any run that is worth waiting for.
const DAY: Duration = Duration::from_secs(24 * 3600);

/// Times a scene.
///
/// # Errors
/// The program does not start, crashes, says nothing that can be understood, or refuses the job.
pub fn time(program: &Path, job: &Job) -> Result<Report, String> {
    match ask(program, &Task::Time(job.clone()), DAY)? {
        Answer::Done(report) => Ok(report),
        Answer::Failed(reason) => Err(reason),
        _ => Err("the worker did something else instead".into()),
    }
}

/// Starts the program, gives it the task and waits for its answer, but not longer than `limit`.
///
/// # Errors
/// The program does not start, crashes, says nothing that can be understood, or takes too long; then it is ended.
pub fn ask(program: &Path, task: &Task, limit: Duration) -> Result<Answer, String> {
    let mut worker = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| format!("{} does not start: {error}", program.display()))?;
    if let Some(mut input) = worker.stdin.take() {
        let line = serde_json::to_string(task).map_err(|error| error.to_string())? + "\n";
        // A worker that died early is reported below by its status.
        let _ = input.write_all(line.as_bytes());
    }
    let output = output_of(&mut worker, limit)?;
    let status = worker.wait().map_err(|error| error.to_string())?;
    if !status.success() {
        return Err(status.to_string());
    }
    serde_json::from_slice(&output)
        .map_err(|error| format!("the worker's answer cannot be understood: {error}"))
}

/// All that the worker prints.
fn output_of(worker: &mut Child, limit: Duration) -> Result<Vec<u8>, String> {
    let mut pipe = worker.stdout.take().ok_or("the worker has no output")?;
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut output = Vec::new();
        let read = pipe.read_to_end(&mut output).map(|_| output);
        // Nobody listens any more when it took too long.
        let _ = sender.send(read);
    });
    let Ok(read) = receiver.recv_timeout(limit) else {
        // It may have ended just now.
        let _ = worker.kill();
        let _ = worker.wait();
        return Err(format!("took longer than {} s", limit.as_secs()));
    };
    read.map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use peers_worker::QualityJob;

    fn task() -> Task {
        Task::Quality(QualityJob { row: "1".into(), other: false, tape: None })
    }

    #[test]
    fn a_crash_and_a_hang_are_errors() {
        let limit = Duration::from_secs(60);
        assert!(ask(Path::new("/no/such/worker"), &task(), limit).is_err());
        assert!(ask(Path::new("false"), &task(), limit).unwrap_err().contains("exit status"));
        // It writes the task back, which is no answer.
        assert!(ask(Path::new("cat"), &task(), limit).unwrap_err().contains("understood"));
        let error = ask(Path::new("yes"), &task(), Duration::ZERO).unwrap_err();
        assert!(error.contains("longer than 0 s"), "{error}");
    }
}
