//! `play`: the playground in the browser, served from this program to this machine alone.

use crate::args::PlayArgs;
use crate::failure::{Failure, Outcome};
use std::fs;
use std::io::{Write, stdout};
use std::path::Path;
use tiny_http::{Header, Method, Request, Response, Server};
use tiny_physics_scenes::find;

/// The files of the playground.
static FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/playground.rs"));

/// Serves until it is stopped.
///
/// # Errors
/// The program has no playground in it, the file cannot be read, or the port is taken.
pub fn run(args: &PlayArgs) -> Outcome {
    if FILES.is_empty() {
        return Err(Failure::new("this program was built without the playground")
            .hint("run scripts/web.sh, which builds it, and then build this program again"));
    }
    let file = args.scene.as_deref().filter(|name| find(name).is_err()).map(Path::new);
    if let Some(file) = file {
        // Better now than in the browser.
        fs::metadata(file).map_err(|error| Failure::new(format!("{}: {error}", file.display())))?;
    }
    let server = Server::http(("127.0.0.1", args.port))
        .map_err(|error| Failure::new(format!("port {}: {error}", args.port)))?;
    let port = server.server_addr().to_ip().map_or(args.port, |address| address.port());
    let place = match (&args.scene, file) {
        (_, Some(file)) => {
            format!("#file={}", escaped(&file.file_name().unwrap_or_default().to_string_lossy()))
        }
        (Some(scene), None) => format!("#{scene}"),
        (None, None) => String::new(),
    };
    writeln!(stdout(), "http://127.0.0.1:{port}/{place}")?;
    stdout().flush()?;
    for request in server.incoming_requests() {
        // Who goes away before the answer is complete has what he wanted.
        let _ = answer(request, file, port);
    }
    Ok(())
}

fn answer(request: Request, file: Option<&Path>, port: u16) -> std::io::Result<()> {
    if *request.method() != Method::Get || !is_for_us(&request, port) {
        return request.respond(Response::empty(403));
    }
    let url = request.url().to_owned();
    let path = url.split(['?', '#']).next().unwrap_or_default();
    let name = match path.trim_start_matches('/') {
        "" => "index.html",
        name => name,
    };
    if let (true, Some(file)) = (name == "file", file) {
        return match fs::read(file) {
            Ok(bytes) => request.respond(Response::from_data(bytes)),
            Err(_) => request.respond(Response::empty(404)),
        };
    }
    match FILES.iter().find(|(own, _)| *own == name) {
        Some((_, bytes)) => request.respond(Response::from_data(*bytes).with_header(kind_of(name))),
        None => request.respond(Response::empty(404)),
    }
}

/// Other pages may send a browser here under a name of their own: they get nothing.
fn is_for_us(request: &Request, port: u16) -> bool {
    let host = request.headers().iter().find(|header| header.field.equiv("Host"));
    let own = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}"));
    host.is_some_and(|host| own.iter().any(|own| host.value.as_str() == own))
}

fn kind_of(name: &str) -> Header {
    let kind = match name.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "svg" => "image/svg+xml",
        _ => "text/plain; charset=utf-8",
    };
    Header::from_bytes("Content-Type", kind).expect("a header in ASCII")
}

/// A name as addresses may have it.
fn escaped(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
    let letter =
        |byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    name.bytes().map(letter).collect()
}
