within HydraulicTestBench.Controllers;
block ValveCompensation "Opening of the servo valve from the flow it is to let through"
  extends Icons.Component;
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Types.Area K(min=1e-9) = 1.863e-5 "Flow over opening and root of pressure over density";
  parameter Types.Density rho(min=1) = 875 "Density of oil";
  parameter Types.Pressure least(min=1) = 5e5 "Pressure drop below which the valve is taken to have this one";
  Interfaces.RealInput flow_ref(unit="m3/s") "Flow that is wanted"
    annotation(Placement(transformation(extent={{-140, 60}, {-100, 100}})));
  Interfaces.RealInput p_s(unit="Pa") "Supply pressure"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput p_L(unit="Pa") "Load pressure"
    annotation(Placement(transformation(extent={{-140, -100}, {-100, -60}})));
  Interfaces.RealOutput u(unit="1") "Opening, within -1 ... 1"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
protected
  discrete Real held(unit="1", start=0, fixed=true) "Output";
  discrete Types.Pressure drop(start=5e5, fixed=true) "Pressure drop of both edges together";
equation
  when sample(0, dt) then
    drop = max(p_s - (if flow_ref < 0 then -p_L else p_L), least);
    held = min(max(flow_ref/(K*sqrt(drop/rho)), -1), 1);
  end when;
  u = held;
  annotation(Documentation(info="<html>
<p>u = Q/(K &radic;((p<sub>s</sub> - sign(Q) p<sub>L</sub>)/&rho;)): with the pressures measured, the valve's flow is
what was asked for, whatever the load.</p>
<p><b>Source:</b> thesis Eq. 5.2 solved for the opening; proposed in its Section 6.1.</p>
<p><b>Valid:</b> a valve whose edges are alike and whose spool is faster than the pressures.</p>
<p><b>Leaves out:</b> overlap of the edges.</p>
</html>"));
end ValveCompensation;
