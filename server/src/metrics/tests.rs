//! Names, units and values of metrics.

use super::*;

#[test]
fn metrics_are_exposed_by_name_and_unit() {
    let metrics = Metrics::default();
    metrics.reclaimed.inc();
    metrics.attempts.inc();
    metrics.claim_latency.observe(0.05);
    metrics.ended(Status::Succeeded);
    let gauges = Gauges {
        jobs: vec![(Status::Queued, 3, 42)],
        oldest_checkpoint_s: 2,
        oldest_progress_s: 7,
        wal_bytes: 4096,
        database_bytes: 8192,
        disk_free_bytes: 1 << 30,
        workers_alive: 2,
        remote_slots: 5,
        workers_failing: 1,
        demand_cpu_s: 90,
        results_to_move: 4,
    };
    let busy = metrics.busy_worker();
    let time = Duration::from_millis(2);
    metrics.answered("GET", "/v1/jobs/{id}", 503, time);
    let open = metrics.stream();
    drop(metrics.stream());
    let text = metrics.text(&gauges).expect("text");
    drop((open, busy));
    for line in [
        "fretwear_jobs{status=\"queued\"} 3",
        "fretwear_oldest_job_age_seconds{status=\"queued\"} 42",
        "fretwear_jobs_ended_total{status=\"succeeded\"} 1",
        "fretwear_rescues_total 1",
        "fretwear_attempts_total 1",
        "fretwear_checkpoints_total 0",
        "fretwear_solve_duration_seconds_count 0",
        "fretwear_stale_writes_refused_total 0",
        "fretwear_claim_latency_seconds_count 1",
        "fretwear_oldest_checkpoint_age_seconds 2",
        "fretwear_wal_size_bytes 4096",
        "fretwear_streams_open 1",
        "fretwear_workers_alive 2",
        "fretwear_workers_busy 1",
        "fretwear_remote_slots 5",
        "fretwear_workers_failing 1",
        "fretwear_demand_cpu_seconds 90",
        "fretwear_results_to_move 4",
        "fretwear_oldest_progress_age_seconds 7",
        "fretwear_database_size_bytes 8192",
        "fretwear_disk_free_bytes 1073741824",
        "fretwear_http_requests_total{method=\"GET\",route=\"/v1/jobs/{id}\",status=\"503\"} 1",
        "fretwear_http_request_duration_seconds_count{method=\"GET\",route=\"/v1/jobs/{id}\"} 1",
    ] {
        assert!(text.lines().any(|found| found == line), "{line} in\n{text}");
    }
    for name in [
        "fretwear_build_info{version=",
        "process_cpu_seconds_total ",
        "process_resident_memory_bytes ",
        "process_open_fds ",
        "process_start_time_seconds ",
    ] {
        let line = text.lines().find(|line| line.starts_with(name));
        assert!(
            line.is_some_and(|line| !line.ends_with(" 0")),
            "{name} in\n{text}"
        );
    }
}
