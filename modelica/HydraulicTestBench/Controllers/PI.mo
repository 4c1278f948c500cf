within HydraulicTestBench.Controllers;
block PI "PI controller as a difference equation, thesis Eq. 5.33"
  extends Icons.Component;
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Real K_p(final unit="1") = 1 "Gain, output over error";
  parameter Types.Duration T_i(min=1e-9) = 1 "Integration time";
  parameter Real low(final unit="1") = -1e30 "Least output";
  parameter Real high(final unit="1") = 1e30 "Largest output";
  parameter Real u_start(final unit="1") = 0 "Output ahead of the first sample";
  Interfaces.RealInput reference(unit="1") "What is wanted"
    annotation(Placement(transformation(extent={{-140, 60}, {-100, 100}})));
  Interfaces.RealInput measured(unit="1") "What is there"
    annotation(Placement(transformation(extent={{-140, 10}, {-100, 50}})));
  Interfaces.RealInput track(unit="1") "Output while it is not active"
    annotation(Placement(transformation(extent={{-140, -50}, {-100, -10}})));
  Interfaces.RealInput active(unit="1") "Controls where this is above 0.5"
    annotation(Placement(transformation(extent={{-140, -100}, {-100, -60}})));
  Interfaces.RealOutput y(unit="1") "Output"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
protected
  discrete Real u(unit="1", start=u_start, fixed=true) "Output";
  discrete Real e(unit="1", start=0, fixed=true) "Error";
  discrete Real begun(unit="1", start=0, fixed=true) "1 once it was active, until it is not";
  discrete Real before(unit="1", start=0, fixed=true) "Error of the sample before, or this one at the first";
equation
  when sample(0, dt) then
    e = reference - measured;
    begun = if active > 0.5 then 1 else 0;
    before = if pre(begun) > 0.5 then pre(e) else e;
    u = min(max(if active > 0.5 then pre(u) + K_p*(e - before) + K_p/T_i*dt*before else track, low), high);
  end when;
  y = u;
  annotation(Documentation(info="<html>
<p>u(k) = u(k-1) + K<sub>p</sub> e(k) + (K<sub>p</sub> dt/T<sub>i</sub> - K<sub>p</sub>) e(k-1). The limited output is
remembered, so that the integral does not wind up. While <code>active</code> is 0 the output follows
<code>track</code>; from there it goes on without a jump.</p>
<p><b>Source:</b> thesis Eq. 5.33; limits and the start are this library's.</p>
<p><b>Valid:</b> any sampling time; its loop needs one well below the loop's own.</p>
<p><b>Leaves out:</b> the time its calculation takes.</p>
</html>"));
end PI;
