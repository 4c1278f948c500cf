within HydraulicTestBench.Effects;
model HoseCompliance "A second volume behind a laminar resistance on each line (hose.compliance)"
  extends Interfaces.PartialHoses;
  parameter Types.Volume V(min=0, max=5e-3, nominal=0.5e-3) = 0 "Volume on each line, 0 = off";
  parameter Types.Duration T(min=1e-5, max=1, nominal=5e-3) = 5e-3 "Time in which it fills";
  constant Types.BulkModulus beta = 1.4e9 "Oil stiffness";
  Types.Pressure p_sA "Pressure behind line A of the supply circuit";
  Types.Pressure p_sB "Pressure behind line B of the supply circuit";
  Types.Pressure p_LA "Pressure behind line A of the load circuit";
  Types.Pressure p_LB "Pressure behind line B of the load circuit";
initial equation
  p_sA = port_sA.p;
  p_sB = port_sB.p;
  p_LA = port_LA.p;
  p_LB = port_LB.p;
equation
  T*der(p_sA) = port_sA.p - p_sA;
  T*der(p_sB) = port_sB.p - p_sB;
  T*der(p_LA) = port_LA.p - p_LA;
  T*der(p_LB) = port_LB.p - p_LB;
  port_sA.q = V/beta*der(p_sA);
  port_sB.q = V/beta*der(p_sB);
  port_LA.q = V/beta*der(p_LA);
  port_LB.q = V/beta*der(p_LB);
  annotation(__HydraulicTestBench(effect="hose.compliance", slot="hoses"), Documentation(info="<html>
<p>What a hose adds to the dead volume at the motor: slow pressures see both volumes, fast ones the near one alone. V
dp/dt = &beta; G (p<sub>near</sub> - p) with the resistance told by T = V/(&beta; G), so that a volume of 0 takes no
oil.</p>
<p><b>Source:</b> this library; beside thesis Eq. 5.10 and 5.23.</p>
<p><b>Valid:</b> below the first resonance of the hose; <code>Hydraulics.Hose</code> has that.</p>
<p><b>Leaves out:</b> inertia of the oil, air in it.</p>
</html>"));
end HoseCompliance;
