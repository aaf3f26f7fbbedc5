//! `fretwear probe`: whether a service here can work, for health checks where no other client is.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::process::ExitCode;
use std::time::Duration;

use crate::cli::runtime;
use crate::cli::terminal::{failed, say};

/// How long the service may take.
const PATIENCE: Duration = Duration::from_secs(4);

pub(super) fn run(listen: SocketAddr) -> ExitCode {
    let runtime = match runtime() {
        Ok(runtime) => runtime,
        Err(cause) => return failed(cause),
    };
    let url = format!("http://{}/readyz", here(listen));
    match runtime.block_on(ask(&url)) {
        Ok(status) if status.is_success() => {
            say("ready");
            ExitCode::SUCCESS
        }
        Ok(status) => failed(format_args!("{url}: {status}")),
        Err(error) => failed(error),
    }
}

async fn ask(url: &str) -> reqwest::Result<reqwest::StatusCode> {
    let client = reqwest::Client::builder().timeout(PATIENCE).build()?;
    Ok(client.get(url).send().await?.status())
}

/// Where a service that listens there is reached from here.
fn here(listen: SocketAddr) -> SocketAddr {
    let ip = match listen.ip() {
        IpAddr::V4(ip) if ip.is_unspecified() => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V6(ip) if ip.is_unspecified() => IpAddr::V6(Ipv6Addr::LOCALHOST),
        ip => ip,
    };
    SocketAddr::new(ip, listen.port())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_service_on_all_addresses_is_asked_on_loopback() {
        for (listen, expected) in [
            ("0.0.0.0:80", "127.0.0.1:80"),
            ("[::]:80", "[::1]:80"),
            ("127.0.0.2:8080", "127.0.0.2:8080"),
        ] {
            let listen: SocketAddr = listen.parse().expect("an address");
            assert_eq!(here(listen).to_string(), expected);
        }
    }
}
