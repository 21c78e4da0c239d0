mod measure;
mod plan;
mod replay;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use tetflip_experiments::family::Member;
fn main() {
    if std::env::args().nth(1).unwrap()=="--replay" { let m: Member = std::env::args().nth(2).unwrap().parse().unwrap(); println!("{}{}", replay::replay(m, plan::number_type(&std::env::args().nth(3).unwrap()).unwrap()), replay::poly(&m.prepare().plc)); return; }
    let mut plan = plan::Plan::quick();
    plan.seeds = std::env::args().nth(1).unwrap().parse().unwrap();
    let filter = std::env::args().nth(2).unwrap_or_default();
    let members: Vec<Member> = Member::all(plan.seeds)
        .into_iter()
        .filter(|m| m.to_string().starts_with(&filter))
        .collect();
    let next = AtomicUsize::new(0);
    let start = std::time::Instant::now();
    let mut all: Vec<measure::Measured> = std::thread::scope(|s| {
        let h: Vec<_> = (0..2)
            .map(|_| {
                s.spawn(|| {
                    let mut v = vec![];
                    loop {
                        let i = next.fetch_add(1, Ordering::Relaxed);
                        if i >= members.len() {
                            return v;
                        }
                        let t=std::time::Instant::now(); v.push(measure::measure(members[i], &plan)); if t.elapsed().as_millis()>300 { println!("SLOW {} {:?}", members[i], t.elapsed()); }
                    }
                })
            })
            .collect();
        h.into_iter().flat_map(|h| h.join().unwrap()).collect()
    });
    println!("{} inputs {:?}", members.len(), start.elapsed());
    all.sort_by_key(|m| m.member.to_string());
    let mut t: BTreeMap<(String, &str, String), usize> = BTreeMap::new();
    for m in &all {
        let k = format!("{}/{}", m.member.family(), m.member.subfamily());
        if !m.cavity_agrees || m.verified == Some(false) {
            println!("BAD {}", m.member);
        }
        for r in &m.runs {
            if measure::is_broken(r) {
                println!("BROKEN {} {:?}", m.member, r);
            }
            let class = r.pieces.first().map_or(String::new(), |p| {
                format!("{} {:?} of {}", p, p.locked_halves, r.pieces.len())
            });
            *t.entry((
                k.clone(),
                plan::name_of(r.times),
                format!("{} {}", r.outcome, class),
            ))
            .or_default() += 1;
            if plan::name_of(r.times) == "f64" && !r.is_ok() && std::env::args().nth(3).is_some() {
                println!(
                    "{} {} {} v={} k={} {:?}",
                    m.member, r.outcome, class, m.vertices, r.disorder.kendall, r.disorder
                );
            }
        }
    }
    for ((k, t, o), n) in t {
        if !(t == "exact" || t == "filtered") {
            println!("{k:28} {t:8} {n:6} {o}");
        }
    }
}
