model LoadedPump "The pump under the orifice of thesis Section 4.2.2, whose pressure follows its angle"
  parameter HydraulicTestBench.Types.Angle a_0 = 0.0 "Angle up to which nothing loads the pump";
  parameter Real c(unit="Pa/rad2") = 0 "Pressure difference over the square of the angle beyond that";
  parameter HydraulicTestBench.Types.Pressure p_low = 25e5 "Pressure of the refilled side, thesis Section 3.1.2";
  input Real alphaCMD(unit="%", min=-100, max=100, start=0, nominal=10) "Swash plate angle command";
  input Real alphaCMD_t(unit="%/s", start=0, nominal=100) "Rate of alphaCMD where known, else 0";
  output Real alphaPercent(unit="%", nominal=10) "Swash plate angle";
  output Real dp(unit="Pa", nominal=1e6) "Pressure difference of the ports";
  output Real f(unit="N", nominal=100) "Pull on the control piston";
  HydraulicTestBench.Pump.A4VSGCoupled pump "Pump";
  HydraulicTestBench.Mechanics.ConstantSpeed drive(w=151.8436) "Drive at 1450 rpm";
  HydraulicTestBench.Hydraulics.PrescribedPressure outlet "Port A";
  HydraulicTestBench.Hydraulics.PrescribedPressure inlet "Port B";
equation
  connect(drive.flange, pump.shaft);
  connect(pump.port_A, outlet.port);
  connect(pump.port_B, inlet.port);
  pump.alphaCMD = alphaCMD;
  pump.alphaCMD_t = alphaCMD_t;
  dp = c*max(pump.alpha - a_0, 0)^2;
  outlet.p = p_low + dp;
  inlet.p = p_low;
  alphaPercent = pump.alphaPercent;
  f = pump.pistonForce.f;
end LoadedPump;
