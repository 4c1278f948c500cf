within HydraulicTestBench.Effects;
model ValveOffset "Zero of the valve's edges off that of the spool (valve.offset)"
  extends Interfaces.PartialSignal;
  parameter Types.SpoolPosition u_n(min=-0.1, max=0.1, nominal=0.01) = 0 "Offset of the opening, 0 = off";
equation
  y = s + u_n;
  annotation(__HydraulicTestBench(effect="valve.offset", slot="spoolOpening"), Documentation(info="<html>
<p>The opening is u + u<sub>n</sub>. The spool sensor sees u.</p>
<p><b>Source:</b> this library; goes into thesis Eq. 3.3.</p>
<p><b>Valid:</b> any u.</p>
</html>"));
end ValveOffset;
