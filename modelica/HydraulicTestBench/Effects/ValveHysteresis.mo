within HydraulicTestBench.Effects;
model ValveHysteresis "Play in the spool's command (valve.hysteresis)"
  extends Interfaces.PartialSignal(y(start=0, fixed=true));
  parameter Types.SpoolPosition h(min=0, max=0.1, nominal=0.01) = 0 "Half of the play, 0 = off";
  constant Types.Duration T_h = 1e-5 "How fast the command is taken along";
equation
  der(y) = (max(s - h - y, 0) + min(s + h - y, 0))/T_h;
  annotation(__HydraulicTestBench(effect="valve.hysteresis", slot="spoolCommand", bypass=true),
    Documentation(info="<html>
<p>The command behind the play stays where it is while the card's command moves freely by 2h. The card's inner loop
sees the true spool. The command has no rate that could be passed on, so it is taken along with the lag
T<sub>h</sub>; at h = 0 only that lag is left, 0.1 degrees at 30 Hz, and <b>off</b> means the neutral filling.</p>
<p><b>Source:</b> this library; thesis Eq. 3.20 for what follows.</p>
<p><b>Valid:</b> changes of the command slower than T<sub>h</sub>.</p>
<p><b>Leaves out:</b> width that depends on amplitude or speed.</p>
</html>"));
end ValveHysteresis;
