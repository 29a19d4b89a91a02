"""A tick as the recording keeps it."""

from math import isfinite

from fieldnav.journal.entry import Judged
from fieldnav.messages import Wheel
from fieldnav.mission.tick import Tick
from fieldnav.recording.records import Line, Module, Seen, Stepped, Ticked
from states.names import text


def ticked(tick: Tick) -> Ticked:
    """How the mission stood, what it commanded, and what the wheels said."""
    motion, place = tick.passed.motion, tick.pose
    return Ticked(
        now_s=tick.now_s,
        state=text(tick.state),
        lane=tick.lane,
        rows=tick.rows,
        rows_passed=tick.rows_passed,
        forward_m=tick.forward_m,
        sideways_m=tick.sideways_m,
        x_m=place.x_m,
        y_m=place.y_m,
        heading_rad=place.heading_rad,
        vx_mps=motion.twist.vx_mps,
        vy_mps=motion.twist.vy_mps,
        yaw_rate_rps=motion.twist.yaw_rate_rps,
        hold=motion.hold,
        refused=tick.passed.reason,
        warning=tick.warning,
        modules={wheel: _module(tick, wheel) for wheel in Wheel},
        charge_percent=tick.report.charge_percent,
    )


def stepped(tick: Tick) -> Stepped:
    """What a state judged, and what it had seen."""
    step, sight = tick.step, tick.step.sight
    state = tick.change.source if tick.change else tick.state
    return Stepped(
        now_s=tick.now_s,
        state=text(state),
        lane=tick.lane,
        forward_m=tick.forward_m,
        event=step.event.value if step.event else "",
        reason=step.reason,
        evidence=tuple(map(Judged.of, step.evidence)),
        frame=Seen.of(sight.frame) if sight else None,
        rows=tuple(
            Line(x_top_px=row.x_top_px, x_bottom_px=row.x_bottom_px, confidence=row.confidence)
            for row in (sight.rows if sight else ())
            if isfinite(row.x_top_px) and isfinite(row.x_bottom_px)
        ),
        plants=len(sight.centres) if sight and sight.centres is not None else None,
    )


def caption(tick: Tick) -> tuple[str, str]:
    """What stands over a picture: state and lane, command."""
    twist = tick.passed.motion.twist
    return (
        f"{text(tick.state)}   lane {tick.lane}",
        f"{tick.now_s:.1f} s   vx {twist.vx_mps:+.2f}  vy {twist.vy_mps:+.2f} m/s  {tick.step.reason}",
    )


def _module(tick: Tick, wheel: Wheel) -> Module:
    told, said = tick.passed.setpoints.get(wheel), tick.report.modules.get(wheel)
    return Module(
        set_speed_mps=told.speed_mps if told else None,
        set_steering_rad=told.steering_rad if told else None,
        speed_mps=said.speed_mps if said else None,
        steering_rad=said.steering_rad if said else None,
        temperature_c=said.temperature_c if said else None,
        battery_v=said.battery_v if said else None,
    )
