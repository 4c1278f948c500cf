within HydraulicTestBench.Effects;
model ValveHysteresis "Play in the spool's command (valve.hysteresis)"
  extends Interfaces.PartialSignal;
  parameter Types.SpoolPosition h(min=0, max=0.1, nominal=0.01) = 0 "Half of the play, 0 = off";
  constant Types.Duration T_h = 3e-4 "How fast the place where the command stays is taken along";
  Types.SpoolPosition m(start=0, fixed=true) "Where the command stays";
equation
  y = noEvent(if s - h > m then s - h elseif s + h < m then s + h else m);
  der(m) = (y - m)/T_h;
  annotation(__HydraulicTestBench(effect="valve.hysteresis", slot="spoolCommand"), Documentation(info="<html>
<p>The command y behind the play stays at m while the card's command s moves freely by 2h; at an end of the play it
follows s at the distance h. The card's inner loop sees the true spool. The place m follows y with the lag
T<sub>h</sub>, of which y sees nothing but where s turns: there y is off by s'' T<sub>h</sub><sup>2</sup> at most. At
h = 0 y is s.</p>
<p><b>Source:</b> this library; thesis Eq. 3.20 for what follows.</p>
<p><b>Valid:</b> commands that turn slower than T<sub>h</sub>.</p>
<p><b>Leaves out:</b> width that depends on amplitude or speed.</p>
</html>"));
end ValveHysteresis;
