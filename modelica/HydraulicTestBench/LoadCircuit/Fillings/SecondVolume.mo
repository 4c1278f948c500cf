within HydraulicTestBench.LoadCircuit.Fillings;
model SecondVolume "A second volume behind a laminar resistance on each line"
  extends Interfaces.PartialHoses;
  parameter Types.Volume V(min=1e-7, nominal=1e-3) = 0.5e-3 "Volume on each line";
  parameter Real G(final unit="m3/(s.Pa)", min=1e-14, nominal=1e-10) = 1e-9 "Flow over pressure difference to it";
  parameter Types.BulkModulus beta = 1.4e9 "Oil stiffness";
  parameter Types.Pressure p_start_s = 25e5 "Pressure at the start, supply circuit";
  parameter Types.Pressure p_start_L = 155e5 "Pressure at the start, load circuit";
  Types.Pressure p_sA(start=p_start_s, fixed=true) "Pressure behind line A of the supply circuit";
  Types.Pressure p_sB(start=p_start_s, fixed=true) "Pressure behind line B of the supply circuit";
  Types.Pressure p_LA(start=p_start_L, fixed=true) "Pressure behind line A of the load circuit";
  Types.Pressure p_LB(start=p_start_L, fixed=true) "Pressure behind line B of the load circuit";
equation
  port_sA.q = G*(port_sA.p - p_sA);
  port_sB.q = G*(port_sB.p - p_sB);
  port_LA.q = G*(port_LA.p - p_LA);
  port_LB.q = G*(port_LB.p - p_LB);
  der(p_sA) = beta/V*port_sA.q;
  der(p_sB) = beta/V*port_sB.q;
  der(p_LA) = beta/V*port_LA.q;
  der(p_LB) = beta/V*port_LB.q;
  annotation(Documentation(info="<html>
<p>What a hose adds to the dead volume at the motor: slow pressures see both volumes, fast ones the near one alone.</p>
<p><b>Source:</b> this library; beside thesis Eq. 5.10 and 5.23.</p>
<p><b>Valid:</b> below the first resonance of the hose; <code>Hydraulics.Hose</code> has that.</p>
<p><b>Leaves out:</b> inertia of the oil.</p>
</html>"));
end SecondVolume;
