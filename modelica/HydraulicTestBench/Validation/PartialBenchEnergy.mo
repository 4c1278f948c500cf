within HydraulicTestBench.Validation;
partial model PartialBenchEnergy "Energy of both circuits and the shaft of the test bench, however it is driven"
  extends Icons.Example;
  LoadCircuit.TestBench bench "Test bench"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  Real given_s(final unit="J", start=0, fixed=true, nominal=1e4) "Put into the supply circuit by pump and refill";
  Real taken_s(final unit="J", start=0, fixed=true, nominal=1e4) "Taken by the supply motor and lost in check valves";
  Real given_L(final unit="J", start=0, fixed=true, nominal=1e4) "Put into the load circuit by its supply";
  Real taken_L(final unit="J", start=0, fixed=true, nominal=1e4) "Taken by the load motor and lost in the valve";
  Real given_w(final unit="J", start=0, fixed=true, nominal=1e4) "Put into the shaft by both motors";
  Real taken_w(final unit="J", start=0, fixed=true, nominal=1e4) "Taken by friction";
  Real passed(final unit="J", start=0, fixed=true, nominal=1e4) "Work that the motors passed on, either way";
  Real stored_s(final unit="J") "In the oil of the supply circuit, beyond the start";
  Real stored_L(final unit="J") "In the oil of the load circuit, beyond the start";
  Real stored_w(final unit="J") "In the motion of the shaft";
  Real error_s(unit="1") = (given_s - taken_s - stored_s)/max(passed, 1) "Supply circuit, over the work passed on";
  Real error_L(unit="1") = (given_L - taken_L - stored_L)/max(passed, 1) "Load circuit, over the work passed on";
  Real error(unit="1") = (given_w - taken_w - stored_w)/max(passed, 1) "Shaft, over the work passed on";
protected
  parameter Types.Pressure p_s = bench.rig.p_refill "Pressure of the supply circuit at the start";
  parameter Types.Pressure p_L = bench.rig.p_sL/2 "Pressure of the load circuit at the start";
equation
  der(given_s) = bench.rig.pumpFlow.tau*bench.rig.pumpFlow.omega - bench.rig.refill.p*bench.rig.refill.port.q;
  der(taken_s) = bench.rig.motorS.tau*bench.rig.omega + bench.rig.refill_A.dp*bench.rig.refill_A.q
    + bench.rig.refill_B.dp*bench.rig.refill_B.q;
  der(given_L) = -bench.rig.supply.p*bench.rig.supply.port.q;
  der(taken_L) = bench.rig.motorL.tau*bench.rig.omega + bench.rig.valve.port_P.p*bench.rig.valve.port_P.q
    + bench.rig.valve.port_T.p*bench.rig.valve.port_T.q + bench.rig.valve.port_A.p*bench.rig.valve.port_A.q
    + bench.rig.valve.port_B.p*bench.rig.valve.port_B.q;
  der(given_w) = (bench.rig.motorS.tau + bench.rig.motorL.tau)*bench.rig.omega;
  der(taken_w) = (bench.Tf + bench.rig.tau_v)*bench.rig.omega;
  der(passed) = abs(bench.rig.motorS.tau*bench.rig.omega) + abs(bench.rig.motorL.tau*bench.rig.omega);
  stored_s = bench.rig.V_s0/(2*bench.rig.beta)*(bench.rig.volume_sA.p^2 + bench.rig.volume_sB.p^2 - 2*p_s^2);
  stored_L = bench.rig.V_L0/(2*bench.rig.beta)*(bench.rig.volume_LA.p^2 + bench.rig.volume_LB.p^2 - 2*p_L^2);
  stored_w = bench.Jeff/2*bench.rig.omega^2;
  annotation(Documentation(info="<html>
<p>What pump, refill and supply put in is taken by motors, valves and friction, or stored: each circuit, and the shaft,
has
an error over the work that the motors passed on. With a stored energy of V p<sup>2</sup>/2&beta;. A model that extends
this one gives the two references of the bench.</p>
<p><b>Source:</b> first law of thermodynamics.</p>
</html>"));
end PartialBenchEnergy;
