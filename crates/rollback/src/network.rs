//! A rough network: UDP on this machine, whose packets come late, in another order, twice, or never.

use ggrs::{Message, NonBlockingSocket};
use rand_pcg::{Pcg32, rand_core::Rng};
use std::io;
use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

/// How rough the network is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Network {
    /// Least time that a packet takes.
    pub delay: Duration,
    /// What is added to it by chance, from nothing to this; so packets overtake each other.
    pub jitter: Duration,
    /// Part of the packets that never come, 0 to 1.
    pub loss: f32,
    /// Part of the packets that come twice, 0 to 1.
    pub twice: f32,
}

/// What a socket did.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Traffic {
    /// Packets that the session sent.
    pub sent: u64,
    /// Those of them that were lost.
    pub lost: u64,
    /// Packets that came.
    pub received: u64,
}

/// A UDP socket that holds packets back, or throws them away.
#[derive(Debug)]
pub struct RoughSocket {
    socket: UdpSocket,
    network: Network,
    random: Pcg32,
    /// On their way: when, to whom, what.
    waiting: Vec<(Instant, SocketAddr, Vec<u8>)>,
    traffic: std::sync::Arc<std::sync::Mutex<Traffic>>,
}

impl RoughSocket {
    /// A socket on a free port of this machine.
    ///
    /// # Errors
    /// The system grants none.
    pub fn open(network: Network, seed: u64) -> io::Result<Self> {
        let socket = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0))?;
        socket.set_nonblocking(true)?;
        let (random, waiting) = (Pcg32::new(seed, 0x6e65_7477), Vec::new());
        Ok(Self { socket, network, random, waiting, traffic: std::sync::Arc::default() })
    }

    /// Where others reach it.
    ///
    /// # Errors
    /// The system does not say.
    pub fn address(&self) -> io::Result<SocketAddr> {
        self.socket.local_addr()
    }

    /// Its counts, which go on while a session owns it.
    pub fn traffic(&self) -> std::sync::Arc<std::sync::Mutex<Traffic>> {
        self.traffic.clone()
    }

    fn count(&self, change: impl FnOnce(&mut Traffic)) {
        change(&mut self.traffic.lock().unwrap_or_else(std::sync::PoisonError::into_inner));
    }

    /// From 0 up to 1.
    fn chance(&mut self) -> f32 {
        (self.random.next_u32() >> 8) as f32 / 16_777_216.0
    }

    /// Sends what has waited long enough.
    fn deliver(&mut self) {
        let (now, socket) = (Instant::now(), &self.socket);
        self.waiting.retain(|(due, address, bytes)| {
            let waits = *due > now;
            if !waits {
                // A packet that the system refuses is a lost one, which the session survives.
                let _ = socket.send_to(bytes, address);
            }
            waits
        });
    }
}

impl NonBlockingSocket<SocketAddr> for RoughSocket {
    fn send_to(&mut self, message: &Message, address: &SocketAddr) {
        let Ok(bytes) = bincode::serialize(message) else { return };
        let lost = self.chance() < self.network.loss;
        self.count(|traffic| {
            traffic.sent += 1;
            traffic.lost += u64::from(lost);
        });
        let copies = if lost { 0 } else { 1 + u32::from(self.chance() < self.network.twice) };
        for _ in 0..copies {
            let due =
                Instant::now() + self.network.delay + self.network.jitter.mul_f32(self.chance());
            self.waiting.push((due, *address, bytes.clone()));
        }
        self.deliver();
    }

    fn receive_all_messages(&mut self) -> Vec<(SocketAddr, Message)> {
        self.deliver();
        let (mut messages, mut buffer) = (Vec::new(), [0; 4096]);
        // Errors of a UDP socket are news of packets that went astray; there is no more to read then.
        while let Ok((length, address)) = self.socket.recv_from(&mut buffer) {
            if let Ok(message) = bincode::deserialize(&buffer[..length]) {
                messages.push((address, message));
            }
        }
        self.count(|traffic| traffic.received += messages.len() as u64);
        messages
    }
}
