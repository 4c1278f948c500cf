within HydraulicTestBench.Effects;
model CardSampling "Sampled output of the controller card (card.sampling)"
  extends Interfaces.PartialSignal(y(start=0, fixed=true));
  parameter Types.Duration T_s(min=0, max=20e-3, nominal=4e-3) = 0 "Sampling time, 0 = off";
  constant Types.Duration T_min = 1e-4 "Shortest sampling time";
protected
  final parameter Types.Duration T_held = max(T_s, T_min) "Sampling time in force";
equation
  when sample(0, T_held) then
    y = s;
  end when;
  annotation(__HydraulicTestBench(effect="card.sampling", slot="cardOutput", bypass=true), Documentation(info="<html>
<p>The card takes its continuous command every T<sub>s</sub> and holds it. A sampling time of 0 has no equation: at
T<sub>s</sub> = 0 it samples every T<sub>min</sub>, and <b>off</b> means the neutral filling.</p>
<p><b>Source:</b> this library; between thesis Eq. 3.17 and 3.20.</p>
<p><b>Valid:</b> T<sub>s</sub> from T<sub>min</sub> up.</p>
<p><b>Leaves out:</b> computing time of the card; it is in the dead time.</p>
</html>"));
end CardSampling;
